"""Hooks into a run: progress bars, traces, profilers and debuggers all hang here.

An observer overrides the hooks it wants. A run collects only overridden ones (`Hooks`), so that a hook nobody uses
costs one test of an empty tuple.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import partial
from typing import Any

from graphface.code_line import own_line
from graphface.fallback import python_warnings, warn
from graphface.graph.request import Request
from graphface.graph.structure import Step
from graphface.record import Record

Hook = Callable[..., None]


class StopRun(BaseException):
    """Raised by an observer to end a run, or to run something else in its place. It is no mistake of anybody's.

    Not an `Exception`: a broken observer is switched off and a node that raises has failed, this passes through both.

    Args:
        why: in a sentence, for the user.
        instead: what the evaluator runs now, on the same tiers, so that nothing is computed twice; None leaves the run
            with this exception.
    """

    def __init__(self, why: str, instead: Request | None = None) -> None:
        super().__init__(why)
        self.instead = instead


class Observer:
    """Base of observers; every hook does nothing.

    Hooks run on the thread that called `run`, except `node_started` and `node_called`. One that raises is switched off
    for the rest of the run, see `Hooks`; `StopRun` ends it.
    """

    def run_started(self, request: Request) -> None:
        """A run begins; `request.steps()` are the nodes that may run or be looked up."""

    def node_started(self, name: str, step: Step | None) -> None:
        """A node's function (or, with no step, an input's file) is about to be evaluated."""

    def node_called(self, name: str, step: Step, arguments: Mapping[str, Any]) -> None:
        """A node's function is about to be called with these values of its ports, besides `step.parameters`.

        What this hook takes does not count in the time of the node.
        """

    def node_finished(self, record: Record, step: Step | None, value: Any) -> None:
        """A node was evaluated, found memoized, failed, was blocked or declined; `value` is None in the last three."""

    def run_finished(self, records: Sequence[Record]) -> None:
        """The run is over, also where it failed or was interrupted."""


class Hooks:
    """The hooks of one run: for each kind those that an observer overrides, ready to be called.

    An observer that raises is switched off for the rest of this run, with a warning: what it watches goes on.
    KeyboardInterrupt and `StopRun` pass, so that a hook can end the run.

        hooks = Hooks(evaluator.observers)
        for hook in hooks.node_finished:
            hook(record, step, value)
    """

    def __init__(self, observers: Iterable[Observer]) -> None:
        watched = [_Watched(observer) for observer in observers]
        self.run_started: tuple[Hook, ...] = _overridden(watched, "run_started")
        self.node_started: tuple[Hook, ...] = _overridden(watched, "node_started")
        self.node_called: tuple[Hook, ...] = _overridden(watched, "node_called")
        self.node_finished: tuple[Hook, ...] = _overridden(watched, "node_finished")
        self.run_finished: tuple[Hook, ...] = _overridden(watched, "run_finished")
        self.any: bool = bool(watched)


class _Watched:
    """One observer in one run, until it breaks."""

    def __init__(self, observer: Observer) -> None:
        self.observer = observer
        self._broken = False
        self._lock = threading.Lock()

    def call(self, hook: Hook, *arguments: Any) -> None:
        if self._broken:
            return
        try:
            hook(*arguments)
        except Exception as error:
            with self._lock:
                first, self._broken = not self._broken, True
            if first:
                _warn_of(hook, error)


def _overridden(watched: Iterable[_Watched], name: str) -> tuple[Hook, ...]:
    base = getattr(Observer, name)
    return tuple(partial(w.call, getattr(w.observer, name)) for w in watched if getattr(type(w.observer), name) != base)


def _warn_of(hook: Hook, error: Exception) -> None:
    """Tell of a broken observer, as something that is no node's fault, even where a node is being called."""
    line = own_line(error, hook)
    where = f" ({line.file}:{line.line})" if line is not None else ""
    name = hook.__qualname__
    with python_warnings():
        warn(f"observer switched off for the rest of the run: {name} raised {type(error).__name__}: {error}{where}")
