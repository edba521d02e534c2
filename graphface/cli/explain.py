"""`graphface explain`: why each node would run or not, compared with the last run that used the same cache."""

from __future__ import annotations

import json
from typing import Annotated

import typer

from graphface.cli.options import (
    Asked,
    Cache,
    CacheSize,
    GraphName,
    Inputs,
    Pins,
    Plugins,
    Profiles,
    Replaces,
    Sets,
    Variants,
    load_graph,
    open_cache,
    read_inputs,
    read_pins,
)


def explain(
    graph: GraphName,
    inputs: Inputs = [],  # noqa: B006
    output: Asked = [],  # noqa: B006
    sets: Sets = [],  # noqa: B006
    replaces: Replaces = [],  # noqa: B006
    variants: Variants = [],  # noqa: B006
    profiles: Profiles = [],  # noqa: B006
    plugins: Plugins = [],  # noqa: B006
    pins: Pins = [],  # noqa: B006
    cache: Cache = None,
    cache_size: CacheSize = None,
    run: Annotated[bool, typer.Option("--run", help="Run it too, and show milliseconds and bytes.")] = False,
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON.")] = False,
) -> None:
    """Say for every node why it runs or not: first seen, a parameter, its code, an input changed, evicted, damaged."""
    from graphface.errors import RunFailed
    from graphface.evaluate.evaluator import Evaluator
    from graphface.report.explain import Sizes, with_results
    from graphface.report.explain import explain as explain_plan
    from graphface.report.history import History, Remember
    from graphface.report.terminal import print_explained

    loaded = load_graph(graph, sets, replaces, variants, profiles, plugins)
    asked = loaded.request(
        read_inputs(inputs), [text.partition("=")[0] for text in output] or None, pinned=read_pins(pins)
    )
    said: list[str] = []
    disk = open_cache(cache, said, cache_size)
    history = History.beside(cache)
    evaluator = Evaluator(disk=disk, observers=[Sizes(), Remember(history, disk)])
    explained = explain_plan(asked, evaluator, history)
    failure = None
    if run:
        try:
            records = evaluator.run(asked).records
        except RunFailed as error:
            failure, records = error, error.records
        explained = with_results(explained, records, said)
    if as_json:
        print(json.dumps([entry.as_json() for entry in explained], indent=1))
    else:
        print_explained(explained)
    if failure is not None:
        raise failure
