"""`graphface bench light`."""

from __future__ import annotations

from typing import Annotated

import typer

from graphface.nodes.commands.bench.options import DATA, Csv, Data

Symmetry = Annotated[
    list[str] | None, typer.Option(metavar="PHOTOS", help="Files, folders or patterns: judge by these photographs.")
]


def light(data: Data = DATA, csv: Csv = None, symmetry: Symmetry = None) -> None:
    """Error of the direction of light that is fitted, by order and robustness, with the CPU time of the fit.

    Data: the path-traced heads of truth/ under lights from one side. The light is fitted in the shipped
    representation, on the mesh's normals and on the true ones. Prints the mean angle to the true direction in degrees.
    With --symmetry photographs judge instead: prints the mean difference between mirrored points of faces, in natural
    logarithms, before and after the estimated shading is divided out, for some variants of `bench lights`.
    """
    if symmetry:
        _print_symmetry(symmetry, csv)
        return
    from statistics import median

    from graphface.nodes.bench.light_truth import light_truth
    from graphface.nodes.commands.bench.figures import TIME_HEADERS, mean_of, time_beside, write_csv
    from graphface.report.terminal import print_table

    figures = list(light_truth(data))
    by_fit = {(f.order, f.robust): [g for g in figures if (g.order, g.robust) == (f.order, f.robust)] for f in figures}
    took = [median(f.milliseconds for f in own) for own in by_fit.values()]
    rows = [
        (
            *(str(order), robust, mean_of((f.mesh_degrees for f in own), 2), mean_of((f.true_degrees for f in own), 2)),
            *time_beside(spent, took[0]),
        )
        for ((order, robust), own), spent in zip(by_fit.items(), took, strict=True)
    ]
    print_table(("order", "robust", ">fitted normals, degrees", ">true normals, degrees", *TIME_HEADERS), rows)
    write_csv(figures, csv)


_VARIANTS = ("as shipped", "light by the face alone", "light by Huber's fit", "light by plain least squares")


def _print_symmetry(photos: list[str], csv: Csv) -> None:
    from graphface.nodes.bench.known_lights import chosen_variants
    from graphface.nodes.bench.light_symmetry import light_symmetry
    from graphface.nodes.commands.bench.figures import mean_of, write_csv
    from graphface.nodes.commands.bench.options import files_of
    from graphface.report.terminal import print_table

    figures = list(light_symmetry(files_of(photos), chosen_variants(_VARIANTS)))
    rows = []
    for variant in dict.fromkeys(f.variant for f in figures):
        own = [f for f in figures if f.variant == variant]
        sides = (mean_of((f.side_before for f in own), 3), mean_of((f.side_after for f in own), 3))
        points = (mean_of((f.points_before for f in own), 3), mean_of((f.points_after for f in own), 3))
        rows.append((variant, str(len(own)), *sides, *points))
    print_table(("variant", ">photos", ">sides before", ">after", ">points before", ">after"), rows)
    write_csv(figures, csv)
