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
Csv = Annotated[Path | None, typer.Option(help="Write every figure here as well.")]
