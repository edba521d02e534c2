"""One run of a graph from the command line: its outputs, and what is written beside them."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from graphface.cli.following import Follower, written
from graphface.cli.output import OutputFiles
from graphface.cli.output_names import check_apart, check_kept, output_files
from graphface.evaluate.evaluator import Evaluator
from graphface.evaluate.observe import Observer
from graphface.facade import Graph
from graphface.record import Record
from graphface.report.history import History, Remember
from graphface.report.terminal import ProgressBar


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
        output: as `-o` says them. Where none is said and the run is looked into, all declared outputs are computed.
        followers: what is written beside the outputs, also where the run fails.
        history: the cache folder, beside which the run is remembered.
        pinned: values that stand in for nodes. observers: further ones.
        quiet: show no progress, since somebody stops the run at nodes.
    """
    looked_into = bool(graph.outputs and (followers or quiet))
    files = output_files(graph, output, given) if output or not looked_into else {}
    asked = graph.request(given, files or None, pinned=pinned)
    outputs = OutputFiles(graph, asked.targets, evaluator)
    outputs.check(files)
    results = [(f"output {name!r}", path) for name, path in files.items()]
    results += [(follower.what, follower.path) for follower in followers if follower.path is not None]
    check_apart(results)
    check_kept((path for _, path in results), [*given.values(), *(pinned or {}).values()])
    with ProgressBar(silent=quiet) as bar, written(followers):
        watching: list[Observer] = [bar, *followers, *observers, *outputs.observers(files)]
        if evaluator.disk is not None:
            watching.append(Remember(History.beside(history), evaluator.disk))
        result = evaluator.run(asked, watching)
    outputs.write(result, files)
    return result.records
