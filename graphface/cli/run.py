"""`graphface run`: evaluate outputs of a graph and write them to files."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from graphface.cli.options import (
    Cache,
    CacheSize,
    GraphName,
    Inputs,
    Memory,
    Pins,
    Plugins,
    Profiles,
    Replaces,
    Sets,
    Variants,
    load_graph,
    open_cache,
    read_inputs,
    read_pins,
)
from graphface.report import picture_size

if TYPE_CHECKING:
    from graphface.record import Record


_INSIDE = "Seeing inside"


def run(
    graph: GraphName,
    inputs: Inputs = [],  # noqa: B006
    output: Annotated[
        list[str],
        typer.Option(
            "-o",
            "--output",
            metavar="[NAME=]FILE",
            help="An output, or any node.port, and its file; as .png, .jpg or .webp any value is a picture.",
        ),
    ] = [],  # noqa: B006
    sets: Sets = [],  # noqa: B006
    replaces: Replaces = [],  # noqa: B006
    variants: Variants = [],  # noqa: B006
    profiles: Profiles = [],  # noqa: B006
    plugins: Plugins = [],  # noqa: B006
    threads: Annotated[int, typer.Option(min=0, help="Nodes that may run at once; 0: one per core.")] = 0,
    guard: Annotated[str, typer.Option(help="What to do about NaN and infinity: off, warn or error.")] = "error",
    cache: Cache = None,
    cache_size: CacheSize = None,
    memory: Memory = None,
    trace: Annotated[
        Path | None,
        typer.Option(metavar="run.json", help="Write what happened at every node.", rich_help_panel=_INSIDE),
    ] = None,
    peaks: Annotated[
        bool,
        typer.Option(
            "--peaks",
            help="Measure each node's peak of memory for --trace: one thread, slower.",
            rich_help_panel=_INSIDE,
        ),
    ] = False,
    pins: Pins = [],  # noqa: B006
    breaks: Annotated[
        list[str],
        typer.Option(
            "--break",
            metavar="NODE[:after]",
            help="Stop before or after this node and ask what to do.",
            rich_help_panel=_INSIDE,
        ),
    ] = [],  # noqa: B006
    save_failure: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE.zip",
            help="Keep what a failing node was given, for graphface replay.",
            rich_help_panel=_INSIDE,
        ),
    ] = None,
    watch: Annotated[
        bool,
        typer.Option(
            "--watch",
            help="Run again whenever a file changes: graph, input, plug-in, operator.",
            rich_help_panel=_INSIDE,
        ),
    ] = False,
    report: Annotated[
        Path | None,
        typer.Option(
            metavar="run.html",
            help="Write a page with a picture of every value, also where the run fails.",
            rich_help_panel=_INSIDE,
        ),
    ] = None,
    report_size: Annotated[
        int,
        typer.Option(
            metavar="PIXELS",
            min=picture_size.SMALLEST,
            max=picture_size.LARGEST,
            help="The longer side of the report's pictures.",
            rich_help_panel=_INSIDE,
        ),
    ] = picture_size.DEFAULT,
    dump: Annotated[
        Path | None,
        typer.Option(
            metavar="DIR",
            help="Write every value of the run: a picture, and .npz without loss.",
            rich_help_panel=_INSIDE,
        ),
    ] = None,
    times: Annotated[
        bool, typer.Option("--times", help="Show the time of every node.", rich_help_panel=_INSIDE)
    ] = False,
    maps: Annotated[
        list[str],
        typer.Option(
            "--map",
            metavar="NAME=FOLDER",
            help="Run for every file of a folder or pattern; name them in -o {NAME}.png.",
        ),
    ] = [],  # noqa: B006
) -> None:
    """Run a graph: [bold]graphface run relight -i photo=portrait.jpg -o relit.png[/bold]"""
    import os

    from graphface.cache.memory import MemoryTier
    from graphface.cli.beside import Beside
    from graphface.cli.run_map import run_map
    from graphface.cli.run_once import run_once
    from graphface.cli.stopping import stopping_at
    from graphface.cli.watch import watch_run
    from graphface.evaluate.evaluator import Evaluator
    from graphface.report.terminal import print_times, print_warnings
    from graphface.settings import memory_budget

    beside = Beside(trace, peaks, report, report_size, dump, save_failure)
    beside.check(maps)
    _check_options(guard, maps=maps, memory=memory, breaks=breaks, watch=watch, pins=pins)
    load = partial(load_graph, graph, sets, replaces, variants, profiles, plugins)
    given, pinned = read_inputs(inputs), read_pins(pins)
    said: list[str] = []
    evaluator = Evaluator(
        memory=MemoryTier(memory_budget(memory)) if maps or breaks or watch else None,
        disk=open_cache(cache, said, cache_size),
        threads=1 if peaks else threads or os.cpu_count() or 1,
        guard=guard,  # type: ignore[arg-type]
    )
    followers = beside.followers(evaluator)
    once = partial(run_once, output=output, given=given, followers=followers, history=cache, pinned=pinned)
    if watch:
        watch_run(load, once, evaluator, [Path(graph), *map(Path, (given | pinned).values())], plugins, cache, times)
        return
    loaded = load()
    records: list[Record] = []
    try:
        if maps:
            run_map(loaded, output, given, maps, evaluator, records)
        else:
            with stopping_at(breaks, loaded, evaluator, threads) as (evaluator, stops):
                records += once(loaded, evaluator=evaluator, observers=stops, quiet=bool(stops))
    finally:
        print_warnings([*(f"{r.name}: {w}" for r in records for w in r.warnings), *said])
        if times and records:
            print_times(records, title="all combinations" if maps else "")


def _check_options(
    guard: str, *, maps: list[str], memory: str | None, breaks: list[str], watch: bool, pins: list[str]
) -> None:
    """Refuse options that do not go together."""
    from graphface.errors import UsageError

    if guard not in ("off", "warn", "error"):
        raise UsageError(f"--guard {guard!r}: expected off, warn or error")
    if maps and (pins or breaks or watch):
        raise UsageError("--pin, --break and --watch are about one run; leave them out with --map")
    if breaks and watch:
        raise UsageError("--break stops one run; leave it out with --watch")
    if memory is not None and not (maps or breaks or watch):
        raise UsageError("--memory is what is kept from one run of --map or --watch to the next; one run keeps nothing")
