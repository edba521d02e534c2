"""`graphface run`: evaluate outputs of a graph and write them to files."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

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
    from graphface.cli.following import Follower
    from graphface.evaluate.evaluator import Evaluator
    from graphface.evaluate.observe import Observer
    from graphface.facade import Graph
    from graphface.record import Record


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
    trace: Annotated[Path | None, typer.Option(metavar="run.json", help="Write what happened at every node.")] = None,
    peaks: Annotated[
        bool, typer.Option("--peaks", help="Measure each node's peak of memory for --trace: one thread, slower.")
    ] = False,
    pins: Pins = [],  # noqa: B006
    breaks: Annotated[
        list[str],
        typer.Option("--break", metavar="NODE[:after]", help="Stop before or after this node and ask what to do."),
    ] = [],  # noqa: B006
    save_failure: Annotated[
        Path | None,
        typer.Option(metavar="FILE.zip", help="Keep what a failing node was given, for graphface replay."),
    ] = None,
    watch: Annotated[
        bool, typer.Option("--watch", help="Run again whenever a file changes: graph, input, plug-in, operator.")
    ] = False,
    report: Annotated[
        Path | None,
        typer.Option(metavar="run.html", help="Write a page with a picture of every value, also where the run fails."),
    ] = None,
    report_size: Annotated[
        int,
        typer.Option(
            metavar="PIXELS",
            min=picture_size.SMALLEST,
            max=picture_size.LARGEST,
            help="The longer side of the report's pictures.",
        ),
    ] = picture_size.DEFAULT,
    dump: Annotated[
        Path | None, typer.Option(metavar="DIR", help="Write every value of the run: a picture, and .npz without loss.")
    ] = None,
    times: Annotated[bool, typer.Option("--times", help="Show the time of every node.")] = False,
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


def run_once(
    graph: Graph,
    output: list[str],
    given: dict[str, str],
    evaluator: Evaluator,
    followers: Sequence[Follower],
    *,
    history: Path | None,
    pinned: dict[str, Any] | None = None,
    observers: Sequence[Observer] = (),
    quiet: bool = False,
) -> list[Record]:
    """One run, its outputs written when all of them are there; what became of every node.

    Args:
        followers: what is written beside the outputs, also where the run fails.
        history: the cache folder, beside which the run is remembered.
        pinned: values that stand in for nodes. observers: further ones. quiet: show no progress.
    """
    from graphface.cli.following import written
    from graphface.cli.output import OutputFiles
    from graphface.report.history import History, Remember
    from graphface.report.terminal import ProgressBar

    files = output_files(graph, output, given)
    asked = graph.request(given, files, pinned=pinned)
    outputs = OutputFiles(graph, asked.targets, evaluator)
    outputs.check(files)
    _check_kept(files.values(), [*given.values(), *(pinned or {}).values()])
    with ProgressBar(silent=quiet) as bar, written(followers):
        watching: list[Observer] = [bar, *followers, *observers, *outputs.observers(files)]
        if evaluator.disk is not None:
            watching.append(Remember(History.beside(history), evaluator.disk))
        result = evaluator.run(asked, watching)
    outputs.write(result, files)
    return result.records


def run_map(
    graph: Graph, output: list[str], given: dict[str, str], maps: list[str], evaluator: Evaluator, records: list[Record]
) -> None:
    """Every combination of the mapped files, one evaluator for all of them; each output as soon as it is there.

    Args:
        evaluator: gets a progress bar. records: gets what became of every node, also where some combinations fail.

    Raises:
        UsageError: two combinations would write the same file. MapFailed: some failed; the others are written.
    """
    from graphface.cli.output import OutputFiles
    from graphface.evaluate.mapping import MapFailed, read_maps, run_over
    from graphface.report.terminal import ProgressBar

    over = read_maps(maps)
    _check_distinct(graph, output, given, over)
    graph.bind(given)  # what all combinations share is refused once, before any runs
    first = output_files(graph, output, {**given, **{name: files[0] for name, files in over.items()}})
    targets = graph.targets(first)
    outputs = OutputFiles(graph, targets, evaluator)
    outputs.check(first)
    failed, total = [], 0
    with ProgressBar() as bar:
        evaluator.observers = (bar, *outputs.observers(first))
        for made in run_over(graph, evaluator, over, given, targets):
            total += 1
            if made.result is None:
                failed.append(made)
                continue
            outputs.write(made.result, output_files(graph, output, made.inputs))
            records += made.result.records
    if failed:
        raise MapFailed(failed, total)


def _check_distinct(graph: Graph, output: list[str], given: dict[str, str], over: dict[str, list[str]]) -> None:
    """Refuse before anything runs what would write a file twice or into a folder that is not there."""
    import itertools

    from graphface.errors import UsageError
    from graphface.values.writing import check_folder

    seen: dict[Path, tuple[str, ...]] = {}
    for values in itertools.product(*over.values()):
        for path in output_files(graph, output, {**given, **dict(zip(over, values, strict=True))}).values():
            if path in seen:
                places = " ".join("{" + name + "}" for name in over)
                raise UsageError(
                    f"{path}: would be written for {', '.join(seen[path])} and for {', '.join(values)}; "
                    f"name the mapped inputs in -o ({places}), and give their files different names"
                )
            seen[path] = values
    _check_kept(seen, itertools.chain(given.values(), *over.values()))
    for folder in {path.parent for path in seen}:
        check_folder(folder / "result")


def _check_kept(results: Iterable[Path], given: Iterable[str]) -> None:
    """Refuse before anything runs to write a result over a file that was given."""
    import os

    from graphface.errors import UsageError

    kept = {os.path.realpath(file) for file in given}
    for path in results:
        if os.path.realpath(path) in kept:
            raise UsageError(f"-o {path}: this file is an input, and would be lost; give the result another name")


def output_files(graph: Graph, asked: list[str], given: dict[str, str]) -> dict[str, Path]:
    """Output name to file; a bare FILE is the graph's first output.

    {photo} in a file name stands for the name of the file given for input `photo`, without folder and suffix.

    Raises:
        UsageError: no output was asked for, one twice, or a file name says {something} that is no input given.
    """
    from graphface.errors import UsageError

    if not asked:
        raise UsageError(f"no output asked for; add -o FILE, or -o NAME=FILE (outputs: {', '.join(graph.outputs)})")
    files: dict[str, Path] = {}
    for text in asked:
        name, equals, file = text.partition("=")
        if not equals:
            if not graph.outputs:
                raise UsageError(f"-o {text}: the graph declares no output; say -o NODE={text}")
            name, file = next(iter(graph.outputs)), text
        if not name or not file:
            raise UsageError(f"-o {text!r}: expected FILE or NAME=FILE")
        if name in files:
            raise UsageError(f"-o {text}: output {name!r} is asked for twice")
        files[name] = Path(_filled(file, given))
    return files


def _filled(template: str, given: dict[str, str]) -> str:
    """A file name with its {input} places filled; what is put in never holds a separator, so it stays in its folder."""
    from graphface.errors import UsageError

    def stem(match: re.Match[str]) -> str:
        name = match.group(1)
        if name not in given:
            raise UsageError(f"-o {template}: no input {name!r} was given (given: {', '.join(given) or 'none'})")
        return re.sub(r"[^\w.-]", "_", Path(given[name]).stem).lstrip(".") or "_"

    return re.sub(r"\{([^{}]*)\}", stem, template)
