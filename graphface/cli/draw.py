"""`graphface draw`: a graph as a picture, a page or a text that other tools draw."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from graphface.cli.options import (
    Cache,
    GraphName,
    Inputs,
    Plugins,
    Profiles,
    Replaces,
    Sets,
    Variants,
    load_graph,
    open_cache,
    read_inputs,
)

if TYPE_CHECKING:
    from graphface.facade import Graph
    from graphface.report.drawing.formats import Format
    from graphface.report.drawing.marks import Mark

_File = Annotated[
    Path | None,
    typer.Option("-o", "--file", metavar="FILE", help="Where to: .html .svg .png .mmd .dot; default: standard output."),
]
_FormatName = Annotated[
    str | None,
    typer.Option(
        "--format",
        metavar="FORMAT",
        help="svg, png, html, mermaid or dot; default: what FILE's suffix says, mermaid on standard output.",
    ),
]
_Outputs = Annotated[
    list[str], typer.Option("--output", metavar="NAME", help="Plan for this output or node.port; default: all.")
]


def draw(
    graph: GraphName,
    file: _File = None,
    form: _FormatName = None,
    inputs: Inputs = [],  # noqa: B006
    output: _Outputs = [],  # noqa: B006
    sets: Sets = [],  # noqa: B006
    replaces: Replaces = [],  # noqa: B006
    variants: Variants = [],  # noqa: B006
    profiles: Profiles = [],  # noqa: B006
    plugins: Plugins = [],  # noqa: B006
    cache: Cache = None,
) -> None:
    """Draw a graph, nested graphs as frames: graphface draw relight -o relight.html

    With -i or --output it shows the plan: what would run, what is memoized,
    and what is skipped, dimmed and with the reason. The page (.html) zooms,
    folds frames, searches, and shows what feeds a node. Mermaid is what
    Markdown viewers draw, dot what Graphviz draws.
    """
    from graphface.errors import UsageError
    from graphface.report.drawing.formats import draw as drawing
    from graphface.report.drawing.formats import format_of, write_drawing

    wanted = _format(form)
    if file is not None:
        wanted = wanted or format_of(file)
    elif wanted == "png":
        raise UsageError("a PNG goes to a file: name one with -o FILE")
    loaded = load_graph(graph, sets, replaces, variants, profiles, plugins)
    marks = _plan(loaded, inputs, output, cache) if inputs or output else {}
    if file is not None:
        write_drawing(loaded, file, wanted, marks)
    else:
        sys.stdout.write(drawing(loaded, wanted or "mermaid", marks).decode())


def _format(name: str | None) -> Format | None:
    from graphface.errors import UsageError, did_you_mean, nearest_names
    from graphface.report.drawing.formats import FORMATS

    if name is None:
        return None
    found = next((known for known in FORMATS if known == name.lower()), None)
    if found is None:
        near = did_you_mean(nearest_names(name, list(FORMATS)))
        raise UsageError(f"--format {name!r}: it is one of {', '.join(FORMATS)}{near}")
    return found


def _plan(graph: Graph, inputs: list[str], outputs: list[str], cache: Path | None) -> dict[str, Mark]:
    """What the plan says about every node."""
    from graphface.evaluate.evaluator import Evaluator
    from graphface.evaluate.plan import plan
    from graphface.report.drawing.planned import marks_of

    request = graph.request(read_inputs(inputs), outputs or None)
    return marks_of(plan(request, Evaluator(disk=open_cache(cache, []))))
