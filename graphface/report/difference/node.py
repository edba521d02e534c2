"""One node that differs."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

from graphface.evaluate.reason import Reason
from graphface.report.difference.values import PartDifference

Kind = Literal["values", "failed", "only here", "only there"]

_OWN = ("operator", "code", "parameter", "wiring", "input", "lazy ports", "unpinned")


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
