"""`graphface run`: evaluate outputs of a graph and write them to files."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from graphface.cli.options import (
    Cache,
    CacheSize,
    GraphName,
    GuardName,
    Inputs,
    Memory,
    Pins,
    Plugins,
    Profiles,
    Replaces,
    Sets,
    Threads,
    Variants,
    load_graph,
    open_evaluator,
    read_inputs,
    read_pins,
)
from graphface.cli.run_options import (
    Breaks,
    DumpFolderPath,
    FailurePath,
    Maps,
    Output,
    Peaks,
    ReportPath,
    ReportSize,
    Times,
    TracePath,
    Watches,
)
from graphface.report import picture_size

if TYPE_CHECKING:
    from graphface.record import Record


def run(
    graph: GraphName,
    inputs: Inputs = [],  # noqa: B006
    output: Output = [],  # noqa: B006
    sets: Sets = [],  # noqa: B006
    replaces: Replaces = [],  # noqa: B006
    variants: Variants = [],  # noqa: B006
    profiles: Profiles = [],  # noqa: B006
    plugins: Plugins = [],  # noqa: B006
    maps: Maps = [],  # noqa: B006
    threads: Threads = 0,
    guard: GuardName = "error",
    cache: Cache = None,
    cache_size: CacheSize = None,
    memory: Memory = None,
    pins: Pins = [],  # noqa: B006
    report: ReportPath = None,
    report_size: ReportSize = picture_size.DEFAULT,
    dump: DumpFolderPath = None,
    times: Times = False,
    trace: TracePath = None,
    peaks: Peaks = False,
    breaks: Breaks = [],  # noqa: B006
    save_failure: FailurePath = None,
    watch: Watches = False,
) -> None:
    """Run a graph: [bold]graphface run relight -i photo=portrait.jpg -o relit.png[/bold]"""
    from graphface.cli.beside import Beside
    from graphface.cli.run_map import run_map
    from graphface.cli.run_once import run_once
    from graphface.cli.stopping import stopping_at
    from graphface.cli.watch import watch_run

    beside = Beside(trace, peaks, report, report_size, dump, save_failure)
    beside.check(maps)
    _check_options(maps=maps, memory=memory, breaks=breaks, watch=watch, pins=pins)
    load = partial(load_graph, graph, sets, replaces, variants, profiles, plugins)
    given, pinned = read_inputs(inputs), read_pins(pins)
    reports: list[str] = []
    keeps = bool(maps or breaks or watch)
    at_once = 1 if peaks else threads
    evaluator = open_evaluator(reports, cache, cache_size, memory, threads=at_once, guard=guard, keeps=keeps)
    followers = beside.followers(evaluator)
    once = partial(run_once, output=output, given=given, followers=followers, history=cache, pinned=pinned)
    if watch:
        watch_run(load, once, evaluator, [Path(graph), *map(Path, (given | pinned).values())], plugins, cache, times)
        return
    loaded = load()
    with _shown(reports, times, "all combinations" if maps else "") as records:
        if maps:
            run_map(loaded, output, given, maps, evaluator, records)
        else:
            with stopping_at(breaks, loaded, evaluator, threads) as (evaluator, stops):
                records += once(loaded, evaluator=evaluator, observers=stops, quiet=bool(stops))


@contextmanager
def _shown(reports: list[str], times: bool, title: str) -> Iterator[list[Record]]:
    """A list for the records of runs; after the block their warnings and times are printed, whatever happened in it."""
    from graphface.report.terminal import print_times, print_warnings

    records: list[Record] = []
    try:
        yield records
    finally:
        print_warnings([*(f"{r.name}: {w}" for r in records for w in r.warnings), *reports])
        if times and records:
            print_times(records, title=title)


def _check_options(*, maps: list[str], memory: str | None, breaks: list[str], watch: bool, pins: list[str]) -> None:
    """Refuse options that do not go together."""
    from graphface.errors import UsageError

    if maps and (pins or breaks or watch):
        raise UsageError("--pin, --break and --watch are about one run; leave them out with --map")
    if breaks and watch:
        raise UsageError("--break stops one run; leave it out with --watch")
    if memory is not None and not (maps or breaks or watch):
        raise UsageError("--memory is what is kept from one run of --map or --watch to the next; one run keeps nothing")
