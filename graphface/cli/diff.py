"""`graphface diff`: which nodes of two runs differ, by how much and why; or which first leave known-good values."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from graphface.cli.options import (
    Cache,
    CacheSize,
    GuardName,
    Inputs,
    Memory,
    Plugins,
    Profiles,
    Replaces,
    Sets,
    Threads,
    Variants,
    open_evaluator,
)

if TYPE_CHECKING:
    from graphface.cli.sides import Flags
    from graphface.evaluate.evaluator import Evaluator
    from graphface.report.difference.compare import Comparison
    from graphface.report.difference.found import Differences
    from graphface.report.difference.golden import GoldenComparison
    from graphface.report.difference.tolerance import Tolerance


_SidesAB = Annotated[
    list[str],
    typer.Argument(
        metavar="A B",
        help='Each a graph with flags in one word ("relight --set face/light.order=1"), a run.json, a report or a '
        "result that carries its graph.",
    ),
]
_Golden = Annotated[
    Path | None,
    typer.Option(metavar="DIR", help="Compare one run with the known-good values that run --dump DIR wrote."),
]
_Page = Annotated[
    Path | None, typer.Option("-o", "--out", metavar="FILE.html", help="Write a page with pictures of all.")
]
_Share = Annotated[
    float | None,
    typer.Option(min=0, help="Differences up to this share of a value's range count as none: 0; --golden 1e-5."),
]
_Absolute = Annotated[
    float | None, typer.Option(min=0, help="Instead of --tolerance: differences up to this count as none.")
]
_Outputs = Annotated[
    list[str], typer.Option(metavar="NAME", help="Compare what this output, or any node.port, needs; default: all.")
]
_Size = Annotated[int, typer.Option(min=64, max=4096, help="Pixels of a picture's longer side in the page.")]


def diff(
    sides: _SidesAB,
    inputs: Inputs = [],  # noqa: B006
    golden: _Golden = None,
    out: _Page = None,
    tolerance: _Share = None,
    absolute: _Absolute = None,
    output: _Outputs = [],  # noqa: B006
    sets: Sets = [],  # noqa: B006
    replaces: Replaces = [],  # noqa: B006
    variants: Variants = [],  # noqa: B006
    profiles: Profiles = [],  # noqa: B006
    plugins: Plugins = [],  # noqa: B006
    size: _Size = 512,
    threads: Threads = 0,
    guard: GuardName = "error",
    cache: Cache = None,
    cache_size: CacheSize = None,
    memory: Memory = None,
) -> None:
    """Compare runs: [bold]graphface diff relight "relight --set face/light.order=1" -i photo=a.jpg -o diff.html[/bold]

    Flags outside the quotes are for both sides. Exit code 0: nothing differs; 1: something does, or fails; 2: mistakes.
    """
    from graphface.cli.sides import Flags
    from graphface.report.terminal import print_warnings
    from graphface.values.writing import check_folder

    _check_count(sides, golden)
    if out is not None:
        check_folder(out)
    reports: list[str] = []
    evaluator = open_evaluator(reports, cache, cache_size, memory, threads=threads, guard=guard)
    allowed = _tolerance(tolerance, absolute, golden=golden is not None)
    common = Flags(inputs, sets, replaces, variants, profiles, plugins)
    done = _compared(sides, golden, common, output, evaluator)
    found = done.differences(allowed)
    _show(found, sides)
    if out is not None:
        from graphface.report.difference.page import write_page

        write_page(done, found, out, size=size, titles=_titles(sides, golden))
        print(f"wrote {out}")
    print_warnings(reports)
    if found or found.failed_alike:
        raise typer.Exit(1)


def _check_count(sides: list[str], golden: Path | None) -> None:
    from graphface.errors import UsageError

    if len(sides) != (2 if golden is None else 1):
        expected = "two sides, A and B, or one with --golden DIR" if golden is None else "one graph beside --golden DIR"
        raise UsageError(f"expected {expected}; got {len(sides)} (put a graph and its flags in quotes)")


def _compared(
    texts: list[str], golden: Path | None, common: Flags, output: list[str], evaluator: Evaluator
) -> Comparison | GoldenComparison:
    """Run what is to be compared."""
    from graphface.cli.sides import bound_inputs, read_sides
    from graphface.report.difference.compare import Comparison
    from graphface.report.difference.golden import GoldenComparison
    from graphface.report.difference.recorded import bound_again, read_recorded
    from graphface.report.dump import RUN
    from graphface.report.terminal import ProgressBar

    given = read_sides(texts, common)
    with ProgressBar() as bar:
        evaluator.observers = (bar,)
        if golden is not None:
            (side,), (inputs,) = given, bound_inputs(given, common.inputs)
            inputs = bound_again(side.graph, read_recorded(golden / RUN), inputs)
            return GoldenComparison(side.graph.request(inputs, output or None), golden, evaluator)
        bound = bound_inputs(given, common.inputs)
        one, other = (s.graph.request(i, output or None) for s, i in zip(given, bound, strict=True))
        return Comparison(one, other, evaluator)


def _tolerance(share: float | None, absolute: float | None, *, golden: bool) -> Tolerance:
    from graphface.errors import UsageError
    from graphface.report.difference.tolerance import GOLDEN, Tolerance

    if share is not None and absolute is not None:
        raise UsageError("--tolerance is a share of the range, --absolute is not; give one of them")
    return Tolerance(share if share is not None else GOLDEN if golden else 0.0, absolute)


def _titles(sides: list[str], golden: Path | None) -> tuple[str, str]:
    return (sides[0], sides[1]) if golden is None else (str(golden), sides[0])


def _show(found: Differences, sides: list[str]) -> None:
    """Print the first difference, the table of all, and what else is worth knowing."""
    from graphface.report.difference.words import HEADER
    from graphface.report.terminal import print_table

    for label, text in zip(found.labels, sides if len(sides) == 2 else (), strict=False):
        print(f"{label}: {text}")
    for line in found.lines:
        print(line)
    if found:
        print()
        print_table(HEADER, found.rows)
        print()
    print(found.summary)
    for line in found.notes:
        print(line)
