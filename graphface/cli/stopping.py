"""`--break`: the evaluator and the observer of a run that stops at nodes."""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from graphface.evaluate.evaluator import Evaluator
    from graphface.evaluate.observe import Observer
    from graphface.facade import Graph


@contextmanager
def stopping_at(
    nodes: list[str], graph: Graph, evaluator: Evaluator, threads: int
) -> Iterator[tuple[Evaluator, Sequence[Observer]]]:
    """What a run that stops at these nodes is run by and followed by; without any, the evaluator as it is.

    Args:
        nodes: "NODE" or "NODE:after". threads: what was asked for, 0 where nothing was.

    Raises:
        InputError: there is no such node. RunError: the user ended the run.
    """
    if not nodes:
        yield evaluator, ()
        return
    from graphface.debug.breakpoint import Breakpoint
    from graphface.debug.evaluator import DebugEvaluator
    from graphface.errors import RunError
    from graphface.evaluate.observe import StopRun

    breakpoint_ = Breakpoint(nodes)
    steps = breakpoint_.check(graph)
    if threads > 1:
        print(f"--break stands at one node at a time: one thread, not {threads}", file=sys.stderr)
    assert evaluator.memory is not None
    debugged = DebugEvaluator(graph, steps, memory=evaluator.memory, disk=evaluator.disk, guard=evaluator.guard)
    try:
        yield debugged, [breakpoint_]
    except StopRun as stop:
        raise RunError(str(stop)) from None
