"""`graphface plan`: what a run would do, and why not the rest."""

from __future__ import annotations

from graphface.cli.options import (
    Asked,
    Cache,
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


def plan(
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
) -> None:
    """Show what a run would do: every node as run, memory, disk, maybe or skipped, with the reason."""
    from graphface.evaluate.evaluator import Evaluator
    from graphface.evaluate.plan import plan as make_plan
    from graphface.report.terminal import print_plan

    loaded = load_graph(graph, sets, replaces, variants, profiles, plugins)
    names = [text.partition("=")[0] for text in output] or None
    print_plan(
        make_plan(
            loaded.request(read_inputs(inputs), names, pinned=read_pins(pins)), Evaluator(disk=open_cache(cache, []))
        )
    )
