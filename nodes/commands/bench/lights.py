"""`graphface bench lights`."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from graphface.nodes.commands.bench.options import DATA, Data

if TYPE_CHECKING:
    from graphface.nodes.bench.known_lights import Figure


def lights(
    out: Annotated[Path | None, typer.Argument(help="Folder for the results, as score.py reads them.")] = None,
    data: Data = DATA,
    truth: Annotated[str, typer.Option(help="heads: path-traced; yale: photographs, one light at a time.")] = "heads",
    source: Annotated[str, typer.Option(help="Light of the photo: frontal, left45, A+050E+00 ...")] = "frontal",
    variant: Annotated[list[str] | None, typer.Option(help="By name; `all` for every one.")] = None,
    every: Annotated[int, typer.Option(min=1, help="Take every n-th person of the Yale set.")] = 1,
) -> None:
    """Relight by known lights with the shipped graph and with parts of it changed: what each gains and costs.

    Data: the path-traced heads of truth/, from the photo under one light to every other, over the face; or the people
    of yaleb/, over the whole crop. Prints a row for the unchanged photo and for each variant: scale-invariant PSNR in
    dB (Yale: scale-invariant MSE) for each light and on average, SSIM, and the CPU time of a change of the light.

    With a folder and several variants, a contact sheet of each head or person beside the truth is written too.
    """
    from graphface import UsageError
    from graphface.nodes.bench.heads import LIGHTS
    from graphface.nodes.bench.known_light_cases import YALE_FRONTAL, YALE_LIGHTS, head_cases, yale_cases
    from graphface.nodes.bench.known_lights import UNCHANGED, chosen_variants, relight_known
    from graphface.nodes.bench.variant_sheet import variant_sheets
    from graphface.report.terminal import print_table

    if truth not in ("heads", "yale"):
        raise UsageError(f"--truth {truth!r}: expected heads or yale")
    sources = LIGHTS if truth == "heads" else ("frontal", *YALE_LIGHTS)
    if source not in sources:
        raise UsageError(f"--source {source!r}: expected {', '.join(sources)}")
    chosen = chosen_variants(variant)
    own = YALE_FRONTAL if source == "frontal" else source
    cases = head_cases(data, source) if truth == "heads" else yale_cases(data, every, own)
    found = list(relight_known(cases, chosen, out))
    names = list(dict.fromkeys(figure.light for figure in found))
    kind, digits = ("si_psnr", 2) if truth == "heads" else ("si_mse", 4)
    rows = [
        _row(name, [f for f in found if f.variant == name], names, kind, digits)
        for name in (UNCHANGED, *(v.name for v in chosen))
    ]
    print_table(("variant", *(f">{light}" for light in names), ">mean", ">SSIM", ">CPU ms"), rows)
    if out is not None and len(chosen) > 1:
        sheets = variant_sheets(out, [v.name for v in chosen], data, truth)
        print(f"wrote {len(sheets)} contact sheets, {out}/sheet-SUBJECT.png")


def _row(name: str, found: Sequence[Figure], lights: Sequence[str], kind: str, digits: int) -> tuple[str, ...]:
    """Mean of one figure for each light and over all of them, mean SSIM, median time."""
    from statistics import fmean, median

    each = [fmean(f.measured[kind] for f in found if f.light == light) for light in lights]
    whole, ssim = fmean(f.measured[kind] for f in found), fmean(f.measured["ssim"] for f in found)
    spent = [f.milliseconds for f in found if f.milliseconds is not None]
    took = f"{median(spent):.0f}" if spent else ""
    return (name, *(f"{value:.{digits}f}" for value in (*each, whole)), f"{ssim:.3f}", took)
