"""Evaluation: what to keep, how many threads, what to do about NaN; one run of it is `graphface.evaluate.run`."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from graphface.cache.disk import DiskTier
from graphface.cache.memory import MISSING, MemoryTier
from graphface.evaluate.calling import Caller, Guard
from graphface.evaluate.observe import Hooks, Observer, StopRun
from graphface.evaluate.run import Run
from graphface.graph.request import Request
from graphface.graph.structure import Step
from graphface.record import Record, State
from graphface.values.frozen import freeze


@dataclass(eq=False)
class Result(Mapping[str, Any]):
    """The outputs of a run by name, and the `records` of every node it touched.

    `request` is what was asked; through it a result keeps its graph and its inputs alive.
    """

    outputs: dict[str, Any]
    records: list[Record] = field(default_factory=list, repr=False)
    request: Request | None = field(default=None, repr=False)

    def __getitem__(self, name: str) -> Any:
        return self.outputs[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self.outputs)

    def __len__(self) -> int:
        return len(self.outputs)

    @property
    def warnings(self) -> list[str]:
        """What nodes fell back on, as "node: sentence"."""
        return [f"{r.name}: {w}" for r in self.records for w in r.warnings]


class Evaluator:
    """Evaluates requests, keeping what it computed. Any number of threads may use one at the same time.

    Args:
        memory: the memory tier; None memoizes nothing beyond one run.
        disk: a disk tier to look into and to fill.
        threads: how many nodes of a run may run at once.
        in_flight: bytes of live values above which nodes run one at a time, whatever `threads` says.
        guard: what to do about NaN and infinity in a node's output.
        observers: listen to every run; see `graphface.evaluate.observe`.
    """

    def __init__(
        self,
        *,
        memory: MemoryTier | None = None,
        disk: DiskTier | None = None,
        threads: int = 1,
        in_flight: int = 4 << 30,
        guard: Guard = "error",
        observers: Sequence[Observer] = (),
    ) -> None:
        self.memory = memory
        self.disk = disk
        self.threads: int = max(1, threads)
        self.in_flight = in_flight
        self.guard: Guard = guard
        self.observers: tuple[Observer, ...] = tuple(observers)
        self._finite: dict[int, Any] = {}

    def run(self, request: Request, observers: Sequence[Observer] = ()) -> Result:
        """The values of a request's targets.

        Args:
            observers: listen to this run only.

        Raises:
            InputError: an input that is needed was not given.
            RunFailed: a node failed; outputs that did not need it are in its `finished`.
            KeyboardInterrupt: between nodes; what was computed stays memoized.
            StopRun: an observer ended the run.
        """
        while True:
            try:
                return self._run(request, observers)
            except StopRun as stop:
                if stop.instead is None:
                    raise
                request = stop.instead

    def _run(self, request: Request, observers: Sequence[Observer]) -> Result:
        hooks = Hooks((*self.observers, *observers))

        def caller(values: dict[bytes, Any]) -> Caller:
            return Caller(request, values, self.guard, self._finite, hooks)

        values, records = Run(request, self, caller, hooks, self.threads, self.in_flight).go()
        return Result(values, records, request)

    def find(self, key: bytes, step: Step | None) -> tuple[Any, State]:
        """A memoized value and the tier that had it, or `MISSING`."""
        if self.memory is not None:
            value = self.memory.get(key)
            if value is not MISSING:
                return value, "memory"
        if self.disk is not None and step is not None:
            value = self.disk.get(key, step.operator.output_annotation)
            if value is not MISSING:
                arrays = freeze(value)
                if self.memory is not None:
                    self.memory.put(key, value, self.disk.cost(key), arrays)
                return value, "disk"
        return MISSING, "ran"

    def keep(self, key: bytes, step: Step | None, value: Any, seconds: float, arrays: tuple[Any, ...]) -> None:
        """Memoize a value that took `seconds` to compute; `arrays` are the buffers it holds."""
        if self.memory is not None:
            self.memory.put(key, value, seconds, arrays)
        if self.disk is not None and step is not None:
            operator = step.operator
            meta = {"operator": operator.name}
            self.disk.put(key, value, cost_seconds=seconds, meta=meta, annotation=operator.output_annotation)
