"""`graphface bench looks`."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from graphface.nodes.commands.bench.options import Photos, files_of
from graphface.nodes.commands.distinct_names import check_distinct

if TYPE_CHECKING:
    from graphface.nodes.bench.relit_looks import Look

_VISIBLE_DIP = 0.03
"""Share of the light from which the shadow of a rim is seen."""


def looks(
    photos: Photos,
    out: Annotated[Path, typer.Option(help="Folder for the cases, SCENE/PHOTO/...")] = Path("looks"),
    scene: Annotated[
        list[str] | None,
        typer.Option(metavar="NAME", help="Shipped scenes or scene files; window-left and split by default."),
    ] = None,
    variant: Annotated[str, typer.Option(help="Of `bench lights`, by name.")] = "as shipped",
    every: Annotated[int, typer.Option(min=1, help="Take every n-th photo.")] = 1,
    long_side: Annotated[int, typer.Option(min=1, help="Pixels to which larger photos are scaled.")] = 1000,
) -> None:
    """Relight photographs and write what a scorer of visible defects reads: one folder for each photo and scene.

    Data: any photographs. Each case holds photo.png, result.png, points.npy (the FaceMesh points), face.png, hair.png
    and background.png (the labels). Prints a row for each scene: the photos, the median light of the cheek far from
    the light over that of the near one (how strong the effect is), and the share of photos on which the edge of the
    face mesh casts a shadow that is seen.
    """
    from graphface import load
    from graphface.nodes.bench.known_lights import chosen_variants
    from graphface.nodes.bench.relit_looks import relit_looks
    from graphface.nodes.bench.shipped import scene_file
    from graphface.report.terminal import print_table

    (changed,) = chosen_variants([variant])
    graph = load("relight", replace=changed.replace, set=changed.set)
    scenes = [scene_file(name) for name in scene or ("window-left", "split")]
    chosen = files_of(photos)[::every]
    for files in (chosen, scenes):
        check_distinct(files)
    found = list(relit_looks(chosen, scenes, graph, out, long_side))
    print_table(
        ("scene", ">photos", ">far / near cheek", ">dip at the rim"),
        [_row(path.stem, [look for look in found if look.scene == path.stem]) for path in scenes],
    )
    print(f"wrote {len(found)} cases to {out}/")


def _row(scene: str, found: Sequence[Look]) -> tuple[str, ...]:
    from math import isnan
    from statistics import fmean, median

    cheeks = [look.cheeks for look in found if not isnan(look.cheeks)]
    dips = [look.rim > _VISIBLE_DIP for look in found if not isnan(look.rim)]
    return (
        scene,
        str(len(found)),
        f"{median(cheeks):.3f}" if cheeks else "-",
        f"{sum(dips)} of {len(dips)}, {fmean(dips):.0%}" if dips else "-",
    )
