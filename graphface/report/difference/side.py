"""One side of a comparison: a request that was run, with every value that it needed at hand.

A run looks at no node behind a memoized one, so afterwards the demand is walked once more (`graphface.graph.demand`),
and values come by key from the evaluator's tiers. One that is no longer there is computed again. Nothing is held here:
two runs of large pictures fit where the memory tier fits.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from graphface.cache.memory import MISSING
from graphface.errors import GraphfaceError, RunFailed
from graphface.evaluate.evaluator import Evaluator
from graphface.graph.demand import declined_with, demanded, take
from graphface.graph.keys import Declined
from graphface.graph.request import Request, request
from graphface.graph.structure import Ref, Step
from graphface.record import Record
from graphface.report.above import above
from graphface.values.picture import View
from graphface.values.port_types import PortType


class Side:
    """A request after its run.

    Args:
        evaluator: where it runs, or ran. records: of its run, where that is over already.

    Attributes:
        needed: the slots that the targets need, by name. declined: why a node that lies behind a declined port, and
            nowhere else, was not needed; by name.
        failures: what went wrong, by node; blocked: the nodes that had to wait for those.
    """

    def __init__(self, asked: Request, evaluator: Evaluator, records: Sequence[Record] | None = None) -> None:
        self.request = asked
        self._evaluator = evaluator
        self.failures: dict[str, str] = {}
        self.blocked: set[str] = set()
        self._answers: dict[str, dict[str, str]] = {}
        self._learn(_ran(asked, evaluator) if records is None else records)
        self.needed: dict[str, int] = {}
        self.declined: dict[str, str] = {}
        self._walk()

    def type_of(self, name: str) -> PortType:
        """The declared type of a needed node or input."""
        return self.request.graph.type_of(Ref(self.needed[name]))

    def value(self, name: str) -> Any:
        """The value of a needed node or input.

        Raises:
            RunFailed, InputError, UnreadableFile: it cannot be had (again).
        """
        slot = self.needed[name]
        found = self._found(slot)
        if found is not MISSING:
            return found
        again = request(self.request.graph, self._given(), [name], self._pinned())
        return self._evaluator.run(again)[name]

    def view(self, name: str, size: int) -> View:
        """How a needed node's value is drawn: what stands above it is looked through as far as it is at hand."""
        return View(size, above(self.request, self.needed[name], self._found))

    def _learn(self, records: Sequence[Record]) -> None:
        """What failed, what was blocked and what was declined; by key, since equal nodes share a record."""
        names: dict[bytes, list[str]] = {}
        for slot, name in enumerate(self.request.graph.names):
            names.setdefault(self.request.key(slot), []).append(name)
        for record in records:
            if record.state == "declined":
                node, _, port = record.name.rpartition(".")
                self._answers.setdefault(node, {})[port] = record.reason
            elif record.state == "failed":
                self.failures.update(dict.fromkeys(names[record.key], record.reason))
            elif record.state == "blocked":
                self.blocked.update(names[record.key])

    def _walk(self) -> None:
        """Follow the demand from the targets upwards."""
        graph = self.request.graph
        stack = [ref.slot for ref in self.request.targets.values()]
        slots: set[int] = set()
        without: list[tuple[int, str]] = []
        while stack:
            slot = stack.pop()
            if slot in slots:
                continue
            slots.add(slot)
            step = self.request.step(slot)
            if step is not None:
                declined = self._declined(step)
                stack += demanded(step, declined)[0]
                without += [
                    (ref.slot, f"{step.name} declined it: {declined[a.port]}")
                    for a in step.arguments
                    if declined is not None and a.port in declined
                    for ref in a.refs
                ]
        self.needed = {graph.names[slot]: slot for slot in sorted(slots)}
        while without:
            slot, why = without.pop()
            name = graph.names[slot]
            if slot in slots or name in self.declined:
                continue
            self.declined[name] = why
            step = self.request.step(slot)
            without += [(above, why) for above in (*step.eager, *step.lazy)] if step is not None else []

    def _declined(self, step: Step) -> Declined | None:
        """What a step declined, in the run, before it, or judged by values that are at hand."""
        if not step.lazy or step.name in self._answers:
            return self._answers.get(step.name, {})
        known = self.request.declined(step)
        if known is not None:
            return known
        try:
            eager = {a.port: self._argument(step, a.port) for a in step.arguments if not a.lazy}
            return declined_with(step, eager)
        except Exception:  # the rule itself fails, or needs what failed: the run has said so
            return None

    def _argument(self, step: Step, port: str) -> Any:
        argument = next(a for a in step.arguments if a.port == port)
        values = []
        for ref in argument.refs:
            self.needed.setdefault(self.request.graph.names[ref.slot], ref.slot)
            values.append(take(self.value(self.request.graph.names[ref.slot]), ref.fields))
        return values if argument.is_list else values[0]

    def _found(self, slot: int) -> Any:
        step = self.request.step(slot)
        bound = self.request.given(slot)
        if bound is not None:
            return bound.value
        return self._evaluator.find(self.request.key(slot), step)[0]

    def _given(self) -> dict[str, Any]:
        return {b.name: b for b in self.request.bound if b is not None}

    def _pinned(self) -> dict[str, Any]:
        return {self.request.graph.names[slot]: bound for slot, bound in self.request.pinned.items()}


def _ran(asked: Request, evaluator: Evaluator) -> Sequence[Record]:
    try:
        return evaluator.run(asked).records
    except RunFailed as error:
        return error.records


def failure_of(error: GraphfaceError) -> str:
    """Why a value could not be had."""
    return "; ".join(f.reason for f in error.failures) if isinstance(error, RunFailed) else str(error)
