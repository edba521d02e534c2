"""Observers that look at the values of a run while they are there, and at what those were made from.

A run drops an array as soon as no node needs it any more. What a value was made from is still there when the value is
told, so weak references are enough, and a drawing needs no value to be kept longer.
"""

from __future__ import annotations

import weakref
from collections.abc import Callable, Sequence
from typing import Any

from graphface.cache.memory import MISSING
from graphface.evaluate.evaluator import Evaluator
from graphface.evaluate.observe import Observer
from graphface.graph.request import Request
from graphface.graph.structure import Step
from graphface.record import Record
from graphface.report.above import above
from graphface.values.parts import SCALARS
from graphface.values.port_types import Atom


class Watcher(Observer):
    """Base of observers of values: `on_value` is called for each one that a run computes or looks up.

    Args:
        evaluator: where values that the run did not need are looked up.
        every: tell also those that are memoized but that the run did not need, at its end.
    """

    def __init__(self, evaluator: Evaluator, *, every: bool = False) -> None:
        self._evaluator = evaluator
        self._every = every
        self._known: dict[int, Callable[[], Any]] = {}
        self._slots: dict[str, int] = {}
        self.request: Request | None = None

    def on_value(self, slot: int, value: Any) -> None:
        """A value of the run is there."""

    def run_started(self, request: Request) -> None:
        self.request = request
        self._slots = {name: slot for slot, name in enumerate(request.graph.names)}
        self._known.clear()

    def node_finished(self, record: Record, step: Step | None, value: Any) -> None:
        if record.state in ("ran", "memory", "disk"):
            slot = self._slots[record.name]
            self._known[slot] = _reference(value)
            self.on_value(slot, value)

    def run_finished(self, records: Sequence[Record]) -> None:
        if self.request is None or not self._every:
            return
        for step in self.request.steps():
            if step.slot not in self._known:
                value = self._stored(step.slot)
                if value is not MISSING:
                    self.on_value(step.slot, value)

    def above(self, slot: int) -> Callable[[Atom], Any]:
        """The nearest value of a type above a slot; see `graphface.report.above`."""
        assert self.request is not None
        return above(self.request, slot, self._value)

    def _value(self, slot: int) -> Any:
        value = self._known[slot]() if slot in self._known else None
        return self._stored(slot) if value is None else value

    def _stored(self, slot: int) -> Any:
        """A value from memory or disk; of an input, what was given, if it was a value or has been read already."""
        assert self.request is not None
        step = self.request.step(slot)
        if step is None:
            bound = self.request.given(slot)
            return MISSING if bound is None else bound.value
        return self._evaluator.find(self.request.key(slot), step)[0]


def _reference(value: Any) -> Callable[[], Any]:
    """A function that gives the value as long as somebody else holds it."""
    if type(value) in SCALARS:
        return lambda: value
    try:
        return weakref.ref(value)
    except TypeError:  # tuples and lists, which may hold arrays
        return lambda: None
