"""`graphface bench intrinsic`."""

from __future__ import annotations

from typing import Annotated

import typer

from graphface.nodes.commands.bench.options import DATA, Csv, Data


def intrinsic(
    data: Data = DATA,
    method: Annotated[list[str] | None, typer.Option(help="Methods of the family; all by default.")] = None,
    csv: Csv = None,
) -> None:
    """Albedo and shading errors of the intrinsic methods, with their CPU time.

    Data: the path-traced heads of truth/ under white lights. Each method runs in the shipped representation. Prints
    the mean scale-invariant and local squared errors of albedo and shading over the face.
    """
    from statistics import median

    from graphface.nodes.bench.intrinsic_truth import intrinsic_truth
    from graphface.nodes.commands.bench.figures import TIME_HEADERS, mean_of, time_beside, write_csv
    from graphface.registry import default_registry
    from graphface.report.terminal import print_table

    registry = default_registry()
    base = registry.operator("intrinsic.intensity")
    names = method or [base.name, *(operator.name for operator in registry.alternatives(base))]
    asked = [registry.operator(name if "." in name else f"intrinsic.{name}").name for name in names]
    figures = list(intrinsic_truth(data, asked))
    measures = ("albedo_si_mse", "albedo_lmse", "shading_si_mse", "shading_lmse")
    took = {name: median(f.milliseconds for f in figures if f.method == name) for name in asked}
    rows = []
    for name in asked:
        own = [f for f in figures if f.method == name]
        means = [mean_of((getattr(f, measure) for f in own), 4) for measure in measures]
        rows.append((name, *means, *time_beside(took[name], took[asked[0]])))
    print_table(("method", *(f">{measure.replace('_', ' ')}" for measure in measures), *TIME_HEADERS), rows)
    write_csv(figures, csv)
