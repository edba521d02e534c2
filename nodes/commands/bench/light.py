"""`graphface bench light`."""

from __future__ import annotations

from graphface.nodes.commands.bench.options import DATA, Csv, Data


def light(data: Data = DATA, csv: Csv = None) -> None:
    """Error of the direction of light that is fitted, by order and robustness, with the CPU time of the fit.

    Data: the path-traced heads of truth/ under lights from one side. The light is fitted in the shipped
    representation, on the mesh's normals and on the true ones. Prints the mean angle to the true direction in degrees.
    """
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
