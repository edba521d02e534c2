"""Hooks into a run: progress bars, traces, profilers and debuggers all hang here.

An observer overrides the hooks it wants. The evaluator collects only overridden ones, so that a hook nobody uses costs
one test of an empty tuple.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import Any

from graphface.graph.request import Request
from graphface.graph.structure import Step
from graphface.record import Record


class Observer:
    """Base of observers; every hook does nothing. Hooks run on the thread that called `run`, except `node_started`."""

    def run_started(self, request: Request) -> None:
        """A run begins; `request.steps()` are the nodes that may run or be looked up."""

    def node_started(self, name: str, step: Step | None) -> None:
        """A node's function (or, with no step, an input's file) is about to be evaluated."""

    def node_finished(self, record: Record, step: Step | None, value: Any) -> None:
        """A node was evaluated, found memoized, failed, was blocked or declined; `value` is None in the last three."""

    def run_finished(self, records: Sequence[Record]) -> None:
        """The run is over, also where it failed or was interrupted."""


Hook = Callable[..., None]


def hooks(observers: Iterable[Observer], name: str) -> tuple[Hook, ...]:
    """The bound methods of those observers that override a hook."""
    base = getattr(Observer, name)
    return tuple(getattr(o, name) for o in observers if getattr(type(o), name) is not base)
