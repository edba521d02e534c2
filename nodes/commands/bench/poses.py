"""`graphface bench poses`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

import typer

from graphface.nodes.commands.bench.options import DATA, Data, Models

if TYPE_CHECKING:
    from graphface.nodes.bench.geometry_photos import PhotoFit


def poses(
    data: Data = DATA,
    model: Models = None,
    every: Annotated[int, typer.Option(min=1, help="Take every n-th of the photographs with automatic points.")] = 4,
) -> None:
    """Fit face models to photographs with 68 points: error, yaw, share of failures; residual on portraits.

    Data: landmarks68/ (large poses), people/ (automatic points) and portraits/. The shipped geometry is fitted to the
    points of the files, on portraits to those of the network. Prints the mean error in per cent of the face's size,
    degrees of yaw off, per cent of failed fits, and the CPU time of a fit; for portraits the median residual in per
    cent of the eye distance.
    """
    from statistics import median

    from graphface import UnreadableFile
    from graphface.nodes.bench import geometry_photos as photos
    from graphface.nodes.morphable.library import named_model
    from graphface.report.terminal import print_table

    rows = []
    for name in model or ["builtin"]:
        own = named_model(name)
        rows.append(_row(own.name, "large poses", list(photos.pose_photos(data / "landmarks68", own))))
        rows.append(_row(own.name, "automatic points", list(photos.automatic_photos(data / "people", own, every))))
        left = list(photos.portrait_residuals(data / "portraits", own, every))
        if not left:
            raise UnreadableFile(data / "portraits", "holds no portrait with a face")
        residual, took = f"{median(r.per_cent for r in left):.2f}", f"{median(r.milliseconds for r in left):.1f}"
        rows.append((own.name, f"portraits ({len(left)}), of eye distance", residual, "", "", took))
    print_table(("model", "photographs", ">error %", ">yaw off deg", ">failed %", ">CPU ms"), rows)


def _row(model: str, title: str, fits: list[PhotoFit]) -> tuple[str, ...]:
    from statistics import fmean, median

    from graphface.nodes.bench.geometry_photos import FAILED
    from graphface.nodes.commands.bench.figures import mean_of

    yaw = mean_of((None if fit.true_yaw is None else abs(fit.yaw - fit.true_yaw) for fit in fits), 1)
    failed = 100 * fmean(fit.error > FAILED for fit in fits)
    took = median(fit.milliseconds for fit in fits)
    return (model, f"{title} ({len(fits)})", mean_of((f.error for f in fits), 2), yaw, f"{failed:.0f}", f"{took:.1f}")
