"""`graphface ablate`: swap parts of a graph and see what each variant gives and what it costs."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from graphface.cli.options import (
    Cache,
    CacheSize,
    GraphName,
    Inputs,
    Memory,
    Plugins,
    Profiles,
    Replaces,
    Sets,
    Variants,
    load_graph,
    open_evaluator,
    read_choices,
)

if TYPE_CHECKING:
    from graphface.ablation.pictures import Pictures
    from graphface.ablation.running import Ablation
    from graphface.facade import Graph


_Swaps = Annotated[
    list[str], typer.Option("--swap", metavar="NODE=A,B", help="Methods of a node, or values of NODE.PARAM.")
]
_Folder = Annotated[Path, typer.Option("-o", "--out", metavar="DIR", help="Folder for the answer.")]
_Output = Annotated[str | None, typer.Option(help="Which output to compare; the graph's first one.")]
_Truth = Annotated[
    Path | None, typer.Option(help="The true output, or a folder that has it under the input's file name.")
]
_Metrics = Annotated[list[str], typer.Option(help="Figures wanted; all that fit by default.")]
_OneAtATime = Annotated[bool, typer.Option("--one-at-a-time", help="Vary one swap at a time.")]
_Nodes = Annotated[
    list[str],
    typer.Option(metavar="NAME", help="A further node, or node.field, to show in the page, with its values."),
]
_Size = Annotated[int, typer.Option(min=64, max=4096, help="Pixels of an output's longer side in the page.")]
_Crop = Annotated[str | None, typer.Option(metavar="X,Y,W,H", help="Window of the crops, in pixels.")]
_Threads = Annotated[int, typer.Option(min=1, help="Nodes at once; 1 keeps node times undisturbed.")]


def ablate(
    graph: GraphName,
    swap: _Swaps,
    inputs: Inputs = [],  # noqa: B006
    out: _Folder = Path("ablation"),
    output: _Output = None,
    truth: _Truth = None,
    metric: _Metrics = [],  # noqa: B006
    one_at_a_time: _OneAtATime = False,
    node: _Nodes = [],  # noqa: B006
    size: _Size = 640,
    crop: _Crop = None,
    sets: Sets = [],  # noqa: B006
    replaces: Replaces = [],  # noqa: B006
    variants: Variants = [],  # noqa: B006
    profiles: Profiles = [],  # noqa: B006
    plugins: Plugins = [],  # noqa: B006
    threads: _Threads = 1,
    cache: Cache = None,
    cache_size: CacheSize = None,
    memory: Memory = None,
) -> None:
    """Compare methods: [bold]graphface ablate relight --swap intrinsic=intensity,retinex -i photo=a.jpg[/bold]

    Repeat -i NAME=FILE for several cases. Writes table.csv, table.md, sheet.png and index.html into the folder.
    """
    from graphface.ablation import ablate as run_ablation
    from graphface.ablation.figures import metrics_for
    from graphface.ablation.pictures import Pictures
    from graphface.values.writing import make_folder

    box = _box(crop)
    base = load_graph(graph, sets, replaces, variants, profiles, plugins)
    cases = read_cases(inputs)
    name = output or next(iter(base.outputs), "")
    declared = base.type_of(base.targets([name])[name])
    truths = [_truth(base, declared, case, truth) for case in cases] if truth is not None else []
    base.targets(node)  # a name that is none is refused before anything runs
    make_folder(out)
    reports: list[str] = []
    evaluator = open_evaluator(reports, cache, cache_size, memory, threads=threads)
    pictures = Pictures(evaluator, name, truths=truths, nodes=node, size=size)
    done = run_ablation(
        graph,
        swap,
        cases,
        output=name,
        truths=truths,
        metrics=metrics_for(declared, base.registry, metric) if truths else (),
        one_at_a_time=one_at_a_time,
        evaluator=evaluator,
        loading={**read_choices(sets, replaces, variants, profiles), "registry": base.registry},
        watcher=pictures,
    )
    _write(done, pictures, out, box)
    _show(done, out, reports)


def _write(done: Ablation, pictures: Pictures, out: Path, box: tuple[int, int, int, int] | None) -> None:
    """Write the table, the sheet and the page into the folder."""
    from graphface.ablation.page import write_page
    from graphface.ablation.sheet import write_sheet
    from graphface.ablation.table import as_csv, as_markdown

    (out / "table.csv").write_text(as_csv(done), encoding="utf-8")
    (out / "table.md").write_text(as_markdown(done), encoding="utf-8")
    write_sheet(done, out / "sheet.png", crop=box)
    write_page(done, pictures, out / "index.html")


def _show(done: Ablation, out: Path, reports: list[str]) -> None:
    """Print the table and what went wrong."""
    from graphface.ablation.table import shown_columns
    from graphface.report.terminal import print_table, print_warnings

    columns = shown_columns(done)
    header = ("variant", *(f">{column.title}" for column in columns[1:]))
    marked = [[f"{text} *" if i in c.best else text for i, text in enumerate(c.texts)] for c in columns]
    print_table(header, list(zip(*marked, strict=True)))
    star = "* the best of its column; " if any(column.best for column in columns) else ""
    print(f"{star}{done.sharing}\nwrote table.csv, table.md, sheet.png and index.html to {out}/")
    failures = [f"{c.variant.name}: {c.failure}" for c in done.cells if c.failure]
    print_warnings([*failures, *dict.fromkeys(w for c in done.cells for w in c.warnings), *reports])


def read_cases(pairs: list[str]) -> list[Mapping[str, Any]]:
    """ "-i" flags as cases: an input given n times makes n cases, one given once is the same in all of them.

    Raises:
        UsageError: two inputs are given several times, but not equally often.
    """
    from graphface.cli.options import read_inputs
    from graphface.errors import UsageError

    given: dict[str, list[Any]] = {}
    for text in pairs:
        for name, value in read_inputs([text]).items():
            given.setdefault(name, []).append(value)
    counts = {len(values) for values in given.values()} - {1}
    if len(counts) > 1:
        counted = ", ".join(f"{name} {len(values)} times" for name, values in given.items())
        raise UsageError(f"inputs are given unequally often: {counted}")
    count = counts.pop() if counts else 1
    return [{name: values[i if len(values) > 1 else 0] for name, values in given.items()} for i in range(count)]


def _truth(graph: Graph, declared: Any, case: Mapping[str, Any], where: Path) -> Any:
    """The true output of a case, read as the output's type."""
    from graphface.errors import UnreadableFile, UsageError

    files = graph.registry.files(declared)
    reader = files.read if files is not None else None
    if reader is None:
        raise UsageError(f"--truth: a {declared} cannot be read from a file")
    if where.is_file():
        return reader(where)
    stems = [Path(str(value)).stem for value in case.values()]
    found = [path for stem in stems for path in sorted(where.glob(f"{stem}.*"))]
    if not found:
        raise UnreadableFile(where, f"holds no file named as an input of the case ({', '.join(stems) or 'none given'})")
    return reader(found[0])


def _box(text: str | None) -> tuple[int, int, int, int] | None:
    from graphface.errors import UsageError

    if text is None:
        return None
    parts = text.split(",")
    if len(parts) != 4 or not all(part.strip().isdigit() for part in parts) or "0" in (parts[2], parts[3]):
        raise UsageError(f"--crop {text!r}: expected X,Y,WIDTH,HEIGHT in pixels")
    left, top, width, height = (int(part) for part in parts)
    return left, top, width, height
