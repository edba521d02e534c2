"""`graphface bench`: accuracy against ground truth, each figure beside what it cost in time."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

app = typer.Typer(help="Measure accuracy on ground truth, and the time it takes.", no_args_is_help=True)

_GEOMETRY_FIGURES = ("landmarks", "normals", "depth")

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


@app.command()
def geometry(
    data: Data = Path("../shared/data"),
    model: Annotated[
        list[str] | None, typer.Option(help="Models to fit, by name or file; the built-in one by default.")
    ] = None,
    lights: Annotated[bool, typer.Option(help="One row a light instead of the mean of all.")] = False,
) -> None:
    """Compare the geometries with the path-traced heads: landmarks, normals, depth, milliseconds."""
    from statistics import fmean, median

    from graphface.nodes.commands.geometry_truth import LIGHTS, geometry_truth
    from graphface.nodes.morphable.library import named_model
    from graphface.terminal import print_table

    found = list(geometry_truth(data, {Path(name).stem: named_model(name) for name in model or ["builtin"]}))
    rows = []
    for name in dict.fromkeys(row.geometry for row in found):
        own = [row for row in found if row.geometry == name]
        for light in (*(LIGHTS if lights else ()), "all"):
            lit = [row for row in own if light in (row.light, "all")]
            points, normals, depth = (fmean(getattr(row, field) for row in lit) for field in _GEOMETRY_FIGURES)
            took = median(row.milliseconds for row in lit)
            rows.append((name, light, f"{points:.2f}", f"{normals:.2f}", f"{depth:.3f}", f"{took:.1f}"))
    print_table(("geometry", "light", ">landmarks %", ">normals deg", ">depth corr.", ">ms"), rows)


@app.command()
def poses(
    data: Data = Path("../shared/data"),
    model: Annotated[
        list[str] | None, typer.Option(help="Models to fit, by name or file; the built-in one by default.")
    ] = None,
    every: Annotated[int, typer.Option(min=1, help="Take every n-th of the photographs with automatic points.")] = 4,
) -> None:
    """Fit face models to photographs with 68 points: error, yaw, share of failures; residual on portraits."""
    from statistics import fmean, median

    from graphface.nodes.commands import geometry_photos as photos
    from graphface.nodes.morphable.library import named_model
    from graphface.terminal import print_table

    rows = []
    for name in model or ["builtin"]:
        own = named_model(name)
        sets = {
            "large poses": list(photos.pose_photos(data / "landmarks68", own)),
            "automatic points": list(photos.automatic_photos(data / "people", own, every)),
        }
        for title, fits in sets.items():
            off = [abs(fit.yaw - fit.true_yaw) for fit in fits if fit.true_yaw is not None]
            failed = fmean(fit.error > photos.FAILED for fit in fits)
            error, yaw = fmean(fit.error for fit in fits), f"{fmean(off):.1f}" if off else ""
            rows.append((own.name, f"{title} ({len(fits)})", f"{error:.2f}", yaw, f"{100 * failed:.0f}"))
        left = [per_cent for _, _, per_cent in photos.portrait_residuals(data / "portraits", own, every)]
        rows.append((own.name, f"portraits ({len(left)}), of eye distance", f"{median(left):.2f}", "", ""))
    print_table(("model", "photographs", ">error %", ">yaw off deg", ">failed %"), rows)
