"""What a comparison found: every node whose value is not the same on both sides, in an order that runs."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Literal

from graphface.evaluate.reason import Reason
from graphface.report.difference.tolerance import EXACT, Tolerance
from graphface.report.difference.values import PartDifference

Kind = Literal["values", "failed", "only here", "only there"]

_OWN = ("operator", "code", "parameter", "wiring", "input", "lazy ports")


@dataclass(frozen=True)
class NodeDifference:
    """One node, or graph input, that differs.

    Attributes:
        operators: on each side, "input" for a graph input, "" where there is none.
        kind: the values differ; it failed on one side at least; only side A ("only there") or side B ("only here") has
            or needs it.
        parts: how far apart the values are, the largest difference first.
        reasons: why the node was not the same to begin with; those of the node itself first. Empty where that is not
            known (a dumped value says only what it is).
        words: of a node that has no two values: what happened, or why one side has none.
    """

    name: str
    operators: tuple[str, str]
    kind: Kind
    parts: tuple[PartDifference, ...] = ()
    reasons: tuple[Reason, ...] = ()
    words: str = ""

    @property
    def caused(self) -> tuple[Reason, ...]:
        """The reasons that lie in the node itself: it would differ if everything above it were equal."""
        return tuple(r for r in self.reasons if r.kind in _OWN)

    @property
    def relative(self) -> float:
        """The greatest difference over the range of the first side's values; infinite where it has no size."""
        return max((part.relative for part in self.parts), default=math.inf)


@dataclass(frozen=True)
class Differences:
    """The answer of a comparison; what is listed differs by more than `tolerance`.

    Attributes:
        labels: what side A and side B are called.
        nodes: in an order that runs. below: those that differ, but by no more than the tolerance.
        without_effect: nodes that were changed themselves and have equal values all the same, with their reasons.
        failed_alike: nodes that fail on both sides in the same way, with the message.
        not_compared: nodes that cannot be, with the reason.
        compared: how many nodes both sides have; equal: how many of them had the same key, and were not looked at.
    """

    labels: tuple[str, str]
    nodes: Sequence[NodeDifference]
    below: Sequence[NodeDifference] = ()
    without_effect: Sequence[tuple[str, tuple[Reason, ...]]] = ()
    failed_alike: Sequence[tuple[str, str]] = ()
    not_compared: Sequence[tuple[str, str]] = ()
    compared: int = 0
    equal: int = 0
    tolerance: Tolerance = EXACT

    def __bool__(self) -> bool:
        """Whether anything differs."""
        return bool(self.nodes)

    def __iter__(self) -> Iterator[NodeDifference]:
        return iter(self.nodes)

    def __len__(self) -> int:
        return len(self.nodes)

    @property
    def first(self) -> NodeDifference | None:
        """The first node in order that both sides have and that differs; where there is none, the first listed."""
        return next((node for node in self.nodes if node.kind in ("values", "failed")), next(iter(self.nodes), None))
