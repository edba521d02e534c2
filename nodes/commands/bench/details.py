"""`graphface bench details`."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from graphface.nodes.bench.detail_looks import DetailLook

_MOST_PATCH, _LEAST_DELIVERED = 2.5, 0.35
"""A pair that keeps both has its detail without a patch."""


def details(
    pairs: Annotated[Path, typer.Argument(help="CSV file of pairs: photo, reference, and regions if not all.")],
    out: Annotated[Path, typer.Option(help="Folder for the cases, PHOTO_REFERENCE/...")] = Path("details"),
    variant: Annotated[list[str] | None, typer.Option(help="Variants of transfer.yaml, by name.")] = None,
) -> None:
    """Transfer detail between pairs of photographs, write what a scorer of visible defects reads, and measure it.

    Data: any photographs, named by a file with a line for each pair. Each case holds photo.png, result.png, warped.png
    (the reference on the photo's face), known.png (where it is shown), mask.png (what was to change), points.npy and
    the labels face.png, hair.png and background.png. Prints the strength of broad change and of changed color in
    percent, and the share of the reference's fine detail that arrived.
    """
    from graphface.nodes.bench.detail_looks import detail_looks, read_pairs
    from graphface.report.terminal import print_table

    found = list(detail_looks(read_pairs(pairs), out, tuple(variant or ())))
    rows = [(look.photo, look.reference, *_cells(look.patch, look.color, look.delivered)) for look in found]
    if found:
        rows.append(("mean", "", *_cells(*_means(found))))
    print_table(("photo", "reference", ">patch %", ">color %", ">delivered"), rows)
    good = sum(look.patch <= _MOST_PATCH and look.delivered > _LEAST_DELIVERED for look in found)
    print(f"patch <= {_MOST_PATCH} and delivered > {_LEAST_DELIVERED}: {good} of {len(found)}; cases in {out}/")


def _cells(*figures: float) -> tuple[str, ...]:
    return tuple(f"{figure:.2f}" for figure in figures)


def _means(found: Sequence[DetailLook]) -> tuple[float, float, float]:
    """Over the pairs that have a figure."""
    from math import isnan
    from statistics import fmean

    columns = ([getattr(look, name) for look in found] for name in ("patch", "color", "delivered"))
    patch, color, delivered = (fmean([v for v in column if not isnan(v)] or [float("nan")]) for column in columns)
    return patch, color, delivered
