"""`graphface run --map`: a graph for every file of a folder."""

from __future__ import annotations

import itertools
import os
from pathlib import Path

from graphface.cli.output import OutputFiles
from graphface.cli.output_names import check_apart, check_kept, output_files
from graphface.errors import UsageError
from graphface.evaluate.evaluator import Evaluator
from graphface.evaluate.mapping import MapFailed, read_maps, run_over
from graphface.graph.wired import WiredGraph
from graphface.record import Record
from graphface.report.terminal import ProgressBar
from graphface.values.writing import check_folder


def run_map(
    graph: WiredGraph,
    output: list[str],
    given: dict[str, str],
    maps: list[str],
    evaluator: Evaluator,
    records: list[Record],
) -> None:
    """Every combination of the mapped files, one evaluator for all of them; each output as soon as it is there.

    Args:
        evaluator: gets a progress bar. records: gets what became of every node, also where some combinations fail.

    Raises:
        UsageError: two combinations would write the same file. MapFailed: some failed; the others are written.
    """
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


def _check_distinct(graph: WiredGraph, output: list[str], given: dict[str, str], over: dict[str, list[str]]) -> None:
    """Refuse before anything runs what would write a file twice or where nothing can be written."""
    seen: dict[str, tuple[str, ...]] = {}
    for values in itertools.product(*over.values()):
        files = output_files(graph, output, {**given, **dict(zip(over, values, strict=True))})
        check_apart((f"output {name!r}", path) for name, path in files.items())
        for path in files.values():
            place = os.path.realpath(path)
            if place in seen:
                places = " ".join("{" + name + "}" for name in over)
                raise UsageError(
                    f"{path}: would be written for {', '.join(seen[place])} and for {', '.join(values)}; "
                    f"name the mapped inputs in -o ({places}), and give their files different names"
                )
            seen[place] = values
    check_kept(map(Path, seen), itertools.chain(given.values(), *over.values()))
    for folder in {os.path.dirname(place) for place in seen}:
        check_folder(Path(folder, "result"))
