"""The options that only `graphface run` has."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from graphface.report import picture_size

_INSIDE = "Seeing inside"

Output = Annotated[
    list[str],
    typer.Option(
        "-o",
        "--output",
        metavar="[NAME=]FILE",
        help="An output, or any node.port, and its file; as .png, .jpg or .webp any value is a picture.",
    ),
]
Maps = Annotated[
    list[str],
    typer.Option(
        "--map", metavar="NAME=FOLDER", help="Run for every file of a folder or pattern; name them in -o {NAME}.png."
    ),
]
TracePath = Annotated[
    Path | None,
    typer.Option("--trace", metavar="run.json", help="Write what happened at every node.", rich_help_panel=_INSIDE),
]
Peaks = Annotated[
    bool,
    typer.Option(
        "--peaks",
        help="Measure each node's peak of memory for --trace: one thread, slower.",
        rich_help_panel=_INSIDE,
    ),
]
Breaks = Annotated[
    list[str],
    typer.Option(
        "--break",
        metavar="NODE[:after]",
        help="Stop before or after this node and ask what to do.",
        rich_help_panel=_INSIDE,
    ),
]
FailurePath = Annotated[
    Path | None,
    typer.Option(
        "--save-failure",
        metavar="FILE.zip",
        help="Keep what a failing node was given, for graphface replay.",
        rich_help_panel=_INSIDE,
    ),
]
Watches = Annotated[
    bool,
    typer.Option(
        "--watch",
        help="Run again whenever a file changes: graph, input, plug-in, operator.",
        rich_help_panel=_INSIDE,
    ),
]
ReportPath = Annotated[
    Path | None,
    typer.Option(
        "--report",
        metavar="run.html",
        help="Write a page with a picture of every value, also where the run fails.",
        rich_help_panel=_INSIDE,
    ),
]
ReportSize = Annotated[
    int,
    typer.Option(
        "--report-size",
        metavar="PIXELS",
        min=picture_size.SMALLEST,
        max=picture_size.LARGEST,
        help="The longer side of the report's pictures.",
        rich_help_panel=_INSIDE,
    ),
]
DumpFolderPath = Annotated[
    Path | None,
    typer.Option(
        "--dump",
        metavar="DIR",
        help="Write every value of the run: a picture, and .npz without loss.",
        rich_help_panel=_INSIDE,
    ),
]
Times = Annotated[bool, typer.Option("--times", help="Show the time of every node.", rich_help_panel=_INSIDE)]
