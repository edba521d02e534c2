"""`graphface bench makeup`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from graphface.nodes.commands.bench.options import DATA, Data


def makeup(
    out: Annotated[Path, typer.Argument(help="Folder for the results: METHOD/A_from_B.png, as score.py reads them.")],
    data: Data = DATA,
    swaps: Annotated[bool, typer.Option(help="Each optical flow and each way of blending in turn.")] = True,
    intrinsic: Annotated[bool, typer.Option(help="Each intrinsic method in turn; takes minutes.")] = False,
) -> None:
    """Give path-traced heads the makeup of others and compare with the truth.

    Data: the pairs of truth/makeup/ and of makeup/. The shipped makeup graph runs as it is, as its variant "paper" (the
    whole skin moves) and with parts swapped, beside simple methods. Prints mean PSNR in dB and SSIM over the face,
    against the head with the reference's whole skin ("full") and, where there is one, with only its paint ("own"; of
    that also where the paint is opaque and where there is none), and the CPU time of a transfer between photos that
    are represented already.
    """
    from graphface.nodes.bench.transfer_truth import TRUTHS, ZONES, makeup_truth
    from graphface.nodes.commands.bench.figures import TIME_HEADERS, time_beside
    from graphface.report.terminal import print_table

    scored = makeup_truth(data, out, swaps=swaps, intrinsic=intrinsic)
    known = [truth for truth in TRUTHS if truth in scored[0].psnr]
    zones = [zone for zone in ZONES if zone in scored[0].psnr]
    first = next(s.milliseconds for s in scored if s.milliseconds is not None)
    rows = []
    for s in scored:
        figures = [cell for truth in known for cell in (f"{s.psnr[truth]:.2f}", f"{s.ssim[truth]:.3f}")]
        figures += [f"{s.psnr[zone]:.2f}" for zone in zones]
        rows.append((s.method, *figures, *(("", "") if s.milliseconds is None else time_beside(s.milliseconds, first))))
    columns = [f">{figure} {truth}" for truth in known for figure in ("PSNR dB", "SSIM")]
    columns += [f">PSNR dB own, {zone}" for zone in zones]
    print_table(("method", *columns, *TIME_HEADERS), rows)
