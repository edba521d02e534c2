"""The evaluator of a debugged run: one thread, a memory tier, and no stored value of what is looked at."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from graphface.cache.disk import DiskTier
from graphface.cache.memory import MISSING, MemoryTier
from graphface.evaluate.calling import Guard
from graphface.evaluate.evaluator import Evaluator
from graphface.graph.structure import Step
from graphface.graph.wired import WiredGraph
from graphface.record import State


class DebugEvaluator(Evaluator):
    """Takes from disk what lies above or beside the nodes that are debugged, never them or what depends on them.

    A breakpoint at a node whose value is on disk would otherwise never be reached. What this evaluator itself computed
    it keeps in memory: a run that begins again after a value was replaced only does what that value reaches.
    """

    def __init__(
        self, graph: WiredGraph, nodes: Iterable[Step], *, memory: MemoryTier, disk: DiskTier | None, guard: Guard
    ) -> None:
        super().__init__(memory=memory, disk=disk, threads=1, guard=guard)
        self._memory = memory
        self._below = {step.slot for step in nodes}
        for step in graph.steps:  # each after what it depends on
            if not self._below.isdisjoint((*step.eager, *step.lazy)):
                self._below.add(step.slot)

    def find(self, key: bytes, step: Step | None) -> tuple[Any, State]:
        if step is None or step.slot not in self._below:
            return super().find(key, step)
        value = self._memory.get(key)
        return value, "ran" if value is MISSING else "memory"
