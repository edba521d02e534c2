"""Options that several benches have."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

Data = Annotated[Path, typer.Option(help="Folder of ground truth; it holds truth/ and its README.")]
DATA = Path("../shared/data")

Models = Annotated[
    list[str] | None, typer.Option("--model", help="Models to fit, by name or file; the built-in one by default.")
]
Photos = Annotated[list[str], typer.Argument(help="Photos: files, folders, or patterns like faces/nm_*.png.")]

Csv = Annotated[Path | None, typer.Option(help="Write every figure here as well.")]


def files_of(places: list[str]) -> list[Path]:
    """Files as they are, and those of folders and patterns.

    Raises:
        UnreadableFile: there is no such folder, or no file in it.
    """
    from graphface.evaluate.mapping import files_at

    return [Path(file) for place in places for file in ([place] if Path(place).is_file() else files_at(place))]
