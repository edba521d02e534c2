"""`graphface bench geometry`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from graphface.nodes.commands.bench.options import DATA, Data, Models


def geometry(
    data: Data = DATA,
    model: Models = None,
    lights: Annotated[bool, typer.Option(help="One row a light instead of the mean of all.")] = False,
) -> None:
    """Compare the geometries with the path-traced heads: landmarks, normals, depth, CPU time.

    Data: the heads of truth/ under each light. The shipped representation runs with FaceMesh's own depth, with each
    model fitted, and with each model's average face. Prints the mean distance to the true 68 points in per cent of the
    eye distance (where a head has them), the mean angle of normals in degrees and the correlation of depth over the
    face, and the CPU time of the mesh.
    """
    from statistics import median

    from graphface.nodes.bench.geometry_truth import geometry_truth
    from graphface.nodes.bench.heads import LIGHTS
    from graphface.nodes.commands.bench.figures import TIME_HEADERS, mean_of, time_beside
    from graphface.nodes.morphable.library import named_model
    from graphface.report.terminal import print_table

    found = list(geometry_truth(data, {Path(name).stem: named_model(name) for name in model or ["builtin"]}))
    first = median(row.milliseconds for row in found if row.geometry == found[0].geometry)
    rows = []
    for name in dict.fromkeys(row.geometry for row in found):
        own = [row for row in found if row.geometry == name]
        for light in (*(LIGHTS if lights else ()), "all"):
            lit = [row for row in own if light in (row.light, "all")]
            points, normals = mean_of((row.landmarks for row in lit), 2), mean_of((row.normals for row in lit), 2)
            depth, took = mean_of((row.depth for row in lit), 3), median(row.milliseconds for row in lit)
            rows.append((name, light, points, normals, depth, *time_beside(took, first)))
    print_table(("geometry", "light", ">landmarks %", ">normals deg", ">depth corr.", *TIME_HEADERS), rows)
