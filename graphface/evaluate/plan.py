"""What a request would do, before it is done: which nodes run, which are memoized, which are skipped and why.

The plan goes by the same rule of demand as a run. Where a `needs` rule has to see a value that is not computed yet, the
nodes behind its lazy ports are "maybe", with the node that will decide.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from graphface.evaluate.evaluator import Evaluator
from graphface.evaluate.reason import NO_REASON, Reason
from graphface.graph.demand import demanded, refused
from graphface.graph.request import Request

Fate = Literal["run", "memory", "disk", "maybe", "skipped", "pinned"]


@dataclass(frozen=True)
class Planned:
    """One node of a plan; `key` is the first hexadecimal digits of its key."""

    name: str
    operator: str
    fate: Fate
    reason: Reason
    key: str


def plan(request: Request, evaluator: Evaluator) -> list[Planned]:
    """Every node of the request's graph with what would become of it, in an order that runs."""
    return _Planner(request, evaluator).run()


class _Planner:
    def __init__(self, request: Request, evaluator: Evaluator) -> None:
        self._request = request
        self._graph = request.graph
        self._evaluator = evaluator
        self._fates: dict[int, tuple[Fate, Reason]] = {}
        self._skipped: dict[int, Reason] = {}

    def run(self) -> list[Planned]:
        self._follow([(ref.slot, "") for ref in self._request.targets.values()])
        for slot, reason in list(self._skipped.items()):
            self._spread(slot, reason)
        unasked = Reason("not needed", new=", ".join(self._request.targets))
        planned = []
        for step in self._graph.steps:
            fate, reason = self._fates.get(step.slot) or ("skipped", self._skipped.get(step.slot, unasked))
            key = self._request.key(step.slot).hex()[:8]
            planned.append(Planned(step.name, step.operator.name, fate, reason, key))
        return planned

    def _follow(self, stack: list[tuple[int, str]]) -> None:
        """Decide the fate of slots and of what they need; the text is who decides, for those that may not run."""
        while stack:
            slot, decider = stack.pop()
            known = self._fates.get(slot)
            if slot in self._request.pinned:
                self._pinned(slot)
                continue
            step = self._graph.step(slot)
            if step is None or (known is not None and (known[0] != "maybe" or decider)):
                continue
            tier = self._tier(self._request.key(slot))
            if tier is not None:
                self._fates[slot] = (tier, NO_REASON)
                for above in (*step.eager, *step.lazy):
                    self._skipped.setdefault(above, Reason("memoized below", node=step.name))
                continue
            self._fates[slot] = ("maybe", Reason("undecided", node=decider)) if decider else ("run", NO_REASON)
            declined = self._request.declined(step)
            surely, perhaps = demanded(step, declined)
            stack.extend((above, decider) for above in surely)
            stack.extend((above, decider or step.name) for above in perhaps)
            for above, why in refused(step, declined or {}).items():
                self._skipped.setdefault(above, Reason("declined", node=step.name, new=why))

    def _pinned(self, slot: int) -> None:
        step = self._graph.step(slot)
        assert step is not None
        self._fates[slot] = ("pinned", Reason("pinned", new=self._request.pinned[slot].origin))
        for above in (*step.eager, *step.lazy):
            self._skipped.setdefault(above, Reason("pinned below", node=step.name))

    def _spread(self, slot: int, reason: Reason) -> None:
        """What stands only behind a skipped node is skipped for the same reason."""
        stack = [slot]
        while stack:
            current = stack.pop()
            step = self._graph.step(current)
            if current in self._fates or step is None:
                continue
            self._skipped.setdefault(current, reason)
            stack.extend(a for a in (*step.eager, *step.lazy) if a not in self._skipped)

    def _tier(self, key: bytes) -> Literal["memory", "disk"] | None:
        if self._evaluator.memory is not None and key in self._evaluator.memory:
            return "memory"
        if self._evaluator.disk is not None and self._evaluator.disk.contains(key):
            return "disk"
        return None
