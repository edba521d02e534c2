"""`graphface bench matting`."""

from __future__ import annotations

from typing import Annotated

import typer

from graphface.nodes.commands.bench.options import Photos, files_of


def matting(
    photos: Photos,
    trust: Annotated[
        float, typer.Option(help="Weight of the soft labels, both ways; 1e-6: Levin's own system.")
    ] = 1e-4,
    tolerance: Annotated[float, typer.Option(help="Relative residual at which the solve in the band stops.")] = 3e-3,
) -> None:
    """Closed-form matting in the band against PyMatting's for the whole picture: CPU seconds, and the alphas apart.

    Data: any photographs with a face, labelled by the shipped representation. Prints for each the share of the band,
    the CPU seconds of both ways and their ratio, and the mean difference of the alphas over picture and band.
    """
    from graphface.nodes.bench.matting_speed import matting_speed
    from graphface.report.terminal import print_table

    found = list(matting_speed(files_of(photos), label_weight=trust, tolerance=tolerance))
    rows = [
        (
            *(one.photo, "x".join(map(str, one.size)), f"{100 * one.share:.0f}"),
            *(f"{one.whole_seconds:.2f}", f"{one.band_seconds:.2f}", f"{one.ratio:.1f}"),
            *(f"{one.picture:.4f}", f"{one.band:.4f}"),
        )
        for one in found
    ]
    print_table(("photo", "size", ">band %", ">whole s", ">band s", ">ratio", ">apart", ">apart in band"), rows)
    least, most = min((one.ratio for one in found), default=0.0), max((one.picture for one in found), default=0.0)
    print(f"ratio at least {least:.1f}, alphas apart by at most {most:.4f} (mean over the picture)")
