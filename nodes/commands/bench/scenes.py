"""`graphface bench scenes`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


def scenes(
    photo: Annotated[Path | None, typer.Option(help="A photograph; scikit-image's astronaut by default.")] = None,
    megapixels: Annotated[float, typer.Option(min=0.01, max=100, help="The photo is scaled to this.")] = 1.0,
    repeats: Annotated[int, typer.Option(min=1, help="Edits timed for each scene; the median counts.")] = 5,
) -> None:
    """What each scene runs and costs once the representation is there.

    Data: one photo, in a session of the shipped relight graph whose scene is edited. Prints a row for each of three
    plain scenes and each shipped one: the nodes that an edit runs, the effects among them, milliseconds to the
    picture, CPU milliseconds of all threads, and the milliseconds as a multiple of copying the arrays it reads.
    """
    from graphface.nodes.bench.scene_cost import scene_costs
    from graphface.report.terminal import print_table

    rows = [
        (
            *(c.scene, str(c.nodes), c.effects, f"{c.milliseconds:.0f}", f"{c.cpu_ms:.0f}"),
            f"{c.milliseconds / max(c.copy, 1e-6):.1f}",
        )
        for c in scene_costs(photo, megapixels, repeats)
    ]
    print_table(("scene", ">nodes run", "effects", ">ms", ">CPU ms", ">copies"), rows)
