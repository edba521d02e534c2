"""Two requests compared, node by node.

Both run on one evaluator. A node whose key is the same on both sides has the same value: nothing of it is run twice or
looked at. Nodes are matched by their path in the graph.
"""

from __future__ import annotations

from dataclasses import replace

from graphface.cache.memory import MemoryTier
from graphface.errors import GraphfaceError
from graphface.evaluate.evaluator import Evaluator
from graphface.evaluate.reason import Reason
from graphface.graph.request import Request
from graphface.report.changes import changes
from graphface.report.difference.found import Differences
from graphface.report.difference.node import NodeDifference
from graphface.report.difference.side import Side, failure_of
from graphface.report.difference.tolerance import EXACT, Tolerance
from graphface.report.difference.values import differences
from graphface.report.history import PINNED, identities


def compare(
    one: Request,
    other: Request,
    evaluator: Evaluator | None = None,
    *,
    labels: tuple[str, str] = ("A", "B"),
    tolerance: Tolerance = EXACT,
) -> Differences:
    """Every node that has not the same value in two requests.

    Args:
        evaluator: where both run; it needs a memory tier, in which values wait for each other.
        tolerance: which differences count as none.

    Raises:
        InputError, UnreadableFile: an input is missing or cannot be read. A node that fails is a difference, no error.
    """
    return Comparison(one, other, evaluator, labels=labels).differences(tolerance)


class Comparison:
    """Two requests that have run, for those who want to look at their values too; see `compare`.

    Attributes:
        sides: the first and the second.
    """

    def __init__(
        self,
        one: Request,
        other: Request,
        evaluator: Evaluator | None = None,
        *,
        labels: tuple[str, str] = ("A", "B"),
    ) -> None:
        if evaluator is None or evaluator.memory is None:
            given = evaluator or Evaluator()
            evaluator = Evaluator(
                memory=MemoryTier(),
                disk=given.disk,
                threads=given.threads,
                guard=given.guard,
                observers=given.observers,
            )
        self.labels = labels
        self.sides = Side(one, evaluator), Side(other, evaluator)
        self._identities = identities(one), identities(other)
        self._changed = {
            name
            for name in self._identities[0].keys() & self._identities[1].keys()
            if self._identities[0][name].key != self._identities[1][name].key
        }

    def differences(self, tolerance: Tolerance = EXACT) -> Differences:
        """Compare the values of all nodes whose keys differ."""
        one, other = self.sides
        listed: list[NodeDifference] = []
        below: list[NodeDifference] = []
        idle, alike, equal = [], [], 0
        for name in merged(list(one.needed), list(other.needed)):
            if name in one.needed and name in other.needed and self._key(0, name) == self._key(1, name):
                equal += 1
                if name in one.failures:
                    alike.append((name, one.failures[name]))
                continue
            found = self._node(name)
            if found is None:
                continue
            if found.kind != "values":
                listed.append(found)
            elif not found.parts:
                if found.caused:
                    idle.append((name, found.caused))
            else:
                (below if all(tolerance.allows(part) for part in found.parts) else listed).append(found)
        both = len(one.needed.keys() & other.needed.keys())
        return Differences(
            self.labels,
            _inheriting_from_differing(listed),
            _inheriting_from_differing(below),
            without_effect=idle,
            failed_alike=alike,
            compared=both,
            equal=equal,
            tolerance=tolerance,
        )

    def _node(self, name: str) -> NodeDifference | None:
        """A node whose keys differ or that one side lacks; None where it is blocked on both sides."""
        one, other = self.sides
        operators = self._operator(0, name), self._operator(1, name)
        if name not in one.needed:
            return NodeDifference(name, operators, "only here", words=self._absence(0, name))
        if name not in other.needed:
            return NodeDifference(name, operators, "only there", words=self._absence(1, name))
        reasons = self._reasons(name)
        stopped = [side.failures.get(name) or ("blocked" if name in side.blocked else "") for side in self.sides]
        if stopped == ["blocked", "blocked"]:
            return None
        if any(stopped):
            words = "; ".join(
                f"{label}: {why if why != 'blocked' else 'a node above it failed'}"
                for label, why in zip(self.labels, stopped, strict=True)
                if why
            )
            return NodeDifference(name, operators, "failed", reasons=reasons, words=words)
        try:
            parts = sorted(differences(one.value(name), other.value(name)), key=lambda p: -p.relative)
        except GraphfaceError as error:
            return NodeDifference(name, operators, "failed", reasons=reasons, words=failure_of(error))
        return NodeDifference(name, operators, "values", tuple(parts), reasons)

    def _reasons(self, name: str) -> tuple[Reason, ...]:
        if name not in self._identities[0] or name not in self._identities[1]:
            origins = [next((b.origin for b in side.request.bound if b and b.name == name), "") for side in self.sides]
            return (Reason("input", node=name, old=origins[0], new=origins[1]),)
        found = list(changes(self._identities[0][name], self._identities[1][name], self._changed))
        # what another input does to a node stands at the input, which is listed itself
        reasons = [Reason("node above", r.node, r.port) if r.kind == "input" else r for r in found]
        return tuple(reasons) or (Reason("lazy ports"),)

    def _absence(self, side: int, name: str) -> str:
        lacking = self.sides[side]
        if name not in lacking.request.graph.names:
            return f"{self.labels[side]} has no such node"
        return f"not needed in {self.labels[side]}: {lacking.declined.get(name, 'nothing that is asked for needs it')}"

    def _operator(self, side: int, name: str) -> str:
        asked = self.sides[side].request
        if name not in asked.graph.names:
            return ""
        slot = asked.graph.names.index(name)
        step = asked.step(slot)
        return step.operator.name if step is not None else PINNED if slot in asked.pinned else "input"

    def _key(self, side: int, name: str) -> bytes:
        return self.sides[side].request.key(self.sides[side].needed[name])


def _inheriting_from_differing(nodes: list[NodeDifference]) -> list[NodeDifference]:
    """The same, each inheriting only from nodes whose values differ; where there are none of those, from all."""
    differing = {node.name for node in nodes}

    def kept(node: NodeDifference) -> tuple[Reason, ...]:
        inherited = [r for r in node.reasons if r.kind == "node above"]
        from_differing = [r for r in inherited if r.node in differing]
        return (*node.caused, *(from_differing or inherited))

    return [replace(node, reasons=kept(node)) for node in nodes]


def merged(one: list[str], other: list[str]) -> list[str]:
    """Names of two sequences in the order of the second; those of the first alone stand before what follows them."""
    here, order = set(other), []
    waiting: dict[str, list[str]] = {}
    pending: list[str] = []
    for name in one:
        if name in here:
            waiting[name], pending = pending, []
        else:
            pending.append(name)
    for name in other:
        order += [*waiting.get(name, ()), name]
    return order + pending
