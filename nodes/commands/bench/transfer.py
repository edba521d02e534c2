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
    graph: Annotated[str, typer.Option(help="What --table draws: makeup or transfer.")] = "makeup",
) -> None:
    """Faithfulness, realism and predictability of makeup on pairs of photographs; with --table, their picture.

    Data: any photographs, every one under every reference, by the shipped makeup graph. Prints how far landmarks of
    eyes, nose and mouth moved beside the detector's own jitter, how similar the features stayed, how much stronger
    the seam around the paint is than the photo's own edges, how near the albedo came to the reference's, and the CPU
    time of the transfer once both photos are represented.
    """
    from graphface.nodes.bench.transfer_criteria import Refused, criteria
    from graphface.nodes.bench.transfer_table import transfer_table
    from graphface.nodes.io.image_write import write_picture
    from graphface.report.terminal import print_table

    inputs, others = files_of([photos]), files_of([references])
    if table is not None:
        write_picture(transfer_table(inputs, others, graph=graph), table)
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
