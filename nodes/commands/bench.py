"""`graphface bench`: accuracy against ground truth, each figure beside what it cost in time."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

app = typer.Typer(help="Measure accuracy on ground truth, and the time it takes.", no_args_is_help=True)

Data = Annotated[Path, typer.Option(help="Folder of ground truth; it holds truth/ and its README.")]


@app.callback()
def bench() -> None:
    """Measure accuracy on ground truth, and the time it takes."""


@app.command()
def relight(
    out: Annotated[Path, typer.Argument(help="Folder for the results: HEAD/LIGHT.png, as score.py reads them.")],
    data: Data = Path("../shared/data"),
    method: Annotated[str, typer.Option(help="detail: additive, multiplicative, split or none.")] = "additive",
    encoding: Annotated[str, typer.Option(help="Values that albedo and shading live in: srgb or linear.")] = "srgb",
) -> None:
    """Relight the path-traced heads by their known lights and compare with the truth."""
    from graphface import UsageError
    from graphface.nodes.commands.truth import relight_truth
    from graphface.terminal import print_table

    if method not in ("additive", "multiplicative", "none", "split"):
        raise UsageError(f"--method {method!r}: expected additive, multiplicative, split or none")
    if encoding not in ("srgb", "linear"):
        raise UsageError(f"--encoding {encoding!r}: expected srgb or linear")
    rows = [
        (r.head, r.light, f"{r.psnr:.2f}", f"{r.si_psnr:.2f}", f"{r.unchanged_psnr:.2f}", f"{r.unchanged_si_psnr:.2f}")
        for r in relight_truth(data, out, encoding=encoding, method=method)  # type: ignore[arg-type]
    ]
    headers = ("head", "light", ">PSNR dB", ">scale-invariant", ">unchanged", ">scale-invariant")
    print_table(headers, rows)
