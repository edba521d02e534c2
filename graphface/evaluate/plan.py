"""What a request would do, before it is done: which nodes run, which are memoized, which are skipped and why.

The plan follows the same demand as the evaluator and asks the same `needs` rules. Where a rule has to see a value that
is not computed yet, the nodes behind its lazy ports are "maybe", with the node that will decide.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

from graphface.evaluate.evaluator import Evaluator
from graphface.graph.inputs import Bound
from graphface.graph.wiring import Ref

if TYPE_CHECKING:
    from graphface.graph.graph import Graph

Fate = Literal["run", "memory", "disk", "maybe", "skipped"]


@dataclass(frozen=True)
class Planned:
    """One node of a plan; `key` is the first hexadecimal digits of its key."""

    name: str
    operator: str
    fate: Fate
    reason: str
    key: str


def plan(graph: Graph, bound: Mapping[str, Bound], targets: Mapping[str, Ref], evaluator: Evaluator) -> list[Planned]:
    """Every node of the graph with what would become of it, in an order that runs."""
    return _Planner(graph, bound, targets, evaluator).run()


class _Planner:
    def __init__(
        self, graph: Graph, bound: Mapping[str, Bound], targets: Mapping[str, Ref], evaluator: Evaluator
    ) -> None:
        self._graph = graph
        self._first = len(graph.inputs)
        self._keys = graph.keys(bound)
        self._targets = targets
        self._evaluator = evaluator
        self._fates: dict[int, tuple[Fate, str]] = {}
        self._skipped: dict[int, str] = {}

    def run(self) -> list[Planned]:
        self._follow([(ref.slot, "") for ref in self._targets.values()])
        for slot, reason in list(self._skipped.items()):
            self._spread_reason(slot, reason)
        asked = ", ".join(self._targets)
        planned = []
        for step in self._graph.steps:
            fate, reason = self._fates.get(step.slot) or (
                "skipped",
                self._skipped.get(step.slot, f"not needed for {asked}"),
            )
            planned.append(Planned(step.name, step.operator.name, fate, reason, self._keys[step.slot].hex()[:8]))
        return planned

    def _follow(self, stack: list[tuple[int, str]]) -> None:
        """Decide the fate of slots and of what they need; the text is who decides, for those that may not run."""
        while stack:
            slot, decider = stack.pop()
            known = self._fates.get(slot)
            if slot < self._first or (known is not None and (known[0] != "maybe" or decider)):
                continue
            step = self._graph.steps[slot - self._first]
            tier = self._tier(self._keys[slot])
            if tier is not None:
                self._fates[slot] = (tier, "")
                for above in (*step.eager, *step.lazy):
                    self._skipped.setdefault(above, f"only {step.name} needs it, and that is memoized")
                continue
            self._fates[slot] = ("maybe", f"{decider} decides when its inputs are there") if decider else ("run", "")
            stack.extend((above, decider) for above in step.eager)
            decisions = self._graph.decisions.get(slot)
            for argument in step.arguments:
                if not argument.lazy:
                    continue
                if decisions is None:
                    stack.extend((ref.slot, decider or step.name) for ref in argument.refs)
                elif argument.port in decisions:
                    for ref in argument.refs:
                        self._skipped.setdefault(ref.slot, decisions[argument.port])
                else:
                    stack.extend((ref.slot, decider) for ref in argument.refs)

    def _spread_reason(self, slot: int, reason: str) -> None:
        """What stands only behind a skipped node is skipped for the same reason."""
        stack = [slot]
        while stack:
            current = stack.pop()
            if current in self._fates or current < self._first:
                continue
            self._skipped.setdefault(current, reason)
            step = self._graph.steps[current - self._first]
            stack.extend(a for a in (*step.eager, *step.lazy) if a not in self._skipped)

    def _tier(self, key: bytes) -> Literal["memory", "disk"] | None:
        if self._evaluator.memory is not None and key in self._evaluator.memory:
            return "memory"
        if self._evaluator.disk is not None and self._evaluator.disk.contains(key):
            return "disk"
        return None
