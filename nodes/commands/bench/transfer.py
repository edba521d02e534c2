"""`graphface bench transfer`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from graphface.nodes.commands.bench.options import files_of


def transfer(
    photos: Annotated[str, typer.Argument(help="Inputs: a file, a folder, or a pattern like faces/nm_*.png.")],
    references: Annotated[str, typer.Argument(help="References: likewise.")],
    table: Annotated[Path | None, typer.Option(help="Also draw the table of results into this picture.")] = None,
    graph: Annotated[str, typer.Option(help="What --table and --out make: makeup or transfer.")] = "makeup",
    out: Annotated[Path | None, typer.Option(help="Folder for the cases of a scorer of visible defects.")] = None,
    variant: Annotated[list[str] | None, typer.Option(metavar="NAME", help="Of the graph, for --out.")] = None,
    every: Annotated[int, typer.Option(min=1, help="With --out: take every n-th pair.")] = 1,
    long_side: Annotated[int, typer.Option(min=1, help="With --out: pixels to which larger photos are scaled.")] = 1000,
) -> None:
    """Faithfulness, realism and predictability of makeup on pairs of photographs; with --table, their picture.

    Data: any photographs, every one under every reference, by the shipped makeup graph. Prints how far landmarks of
    eyes, nose and mouth moved beside the detector's own jitter, how similar the features stayed, how much stronger
    the seam around the paint is than the photo's own edges, how near the albedo came to the reference's, and the CPU
    time of the transfer once both photos are represented.

    With --out each pair becomes a folder with photo, result, landmarks, labels and the warped reference, and what is
    printed instead is seen: the change of the skin, the hue of the lips, how much of the reference's brows and of its
    eye paint arrived, what changed beyond the face, and how much of the face kept its own pixels.
    """
    from graphface.nodes.bench.transfer_criteria import Refused, criteria
    from graphface.nodes.bench.transfer_table import transfer_table
    from graphface.nodes.io.image_write import write_picture
    from graphface.report.terminal import print_table

    inputs, others = files_of([photos]), files_of([references])
    if table is not None:
        write_picture(transfer_table(inputs, others, graph=graph), table)
    if out is not None:
        _print_looks(inputs, others, graph, out, variant or [], every, long_side)
        return
    rows: list[tuple[str, ...]] = []
    for found in criteria(inputs, others):
        if isinstance(found, Refused):
            rows.append((found.photo, found.reference, found.reason, *[""] * 6))
            continue
        shift, floor = 100 * found.shift, 100 * found.floor
        figures = (shift, floor, found.similarity, found.seam, found.albedo_before, found.albedo_after)
        cells = (f"{figure:.3f}" for figure in figures)
        rows.append((found.photo, found.reference, *cells, f"{found.milliseconds:.0f}"))
    shifts = (">landmark shift, % of eyes", ">of recoloring alone")
    figures_ = (">similarity", ">seam", ">albedo before", ">albedo after", ">CPU ms")
    print_table(("photo", "reference", *shifts, *figures_), rows)


def _print_looks(
    inputs: list[Path], others: list[Path], graph: str, out: Path, variants: list[str], every: int, long_side: int
) -> None:
    from statistics import fmean

    from graphface import load
    from graphface.nodes.bench.transfer_looks import transfer_looks
    from graphface.report.terminal import print_table

    names = ("skin", "lips", "brow", "eyes", "outside", "untouched")
    rows, figures = [], []
    for look in transfer_looks(inputs, others, load(graph, variants=variants), out, long_side, every):
        figures.append([getattr(look, name) for name in names])
        rows.append((look.photo, look.reference, *(f"{figure:.2f}" for figure in figures[-1])))
    known = [[value for value in column if value == value] for column in zip(*figures, strict=True)]
    rows.append(("mean", str(len(figures)), *(f"{fmean(column):.2f}" if column else "-" for column in known)))
    columns = (">skin dE", ">lips, degrees", ">brow", ">eye paint", ">outside", ">untouched")
    print_table(("photo", "reference", *columns), rows)
