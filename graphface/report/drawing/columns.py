"""The order of items in their columns, so that few links cross: sweeps that sort by the mean place of the neighbors.

Wires that skip columns pass them in lanes, which are items of their own. Every round of sweeps is counted, the best
one kept (Sugiyama, Tagawa, Toda 1981; counting after Barth, Mutzel, Jünger 2004).
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass

_ROUNDS, _PATIENCE = 24, 6


@dataclass(frozen=True)
class Joint:
    """A link between neighboring columns; `leaves` and `enters` are shares of the items' heights, in 0..1."""

    source: int
    target: int
    leaves: float
    enters: float


def ordered(columns: Sequence[Sequence[int]], joints: Sequence[Joint], count: int) -> list[list[int]]:
    """The columns with their items in an order with few crossings.

    Args:
        columns: the items of each column, in the order they came.
        count: how many items there are, in all columns.
    """
    sweep = _Sweep(columns, joints, count)
    best, fewest, since = [list(c) for c in sweep.columns], sweep.crossings(), 0
    for turn in range(_ROUNDS):
        if not fewest or since >= _PATIENCE:
            break
        sweep.round(to_right=turn % 2 == 0)
        crossings = sweep.crossings()
        since += 1
        if crossings < fewest:
            best, fewest, since = [list(c) for c in sweep.columns], crossings, 0
    return best


class _Sweep:
    def __init__(self, columns: Sequence[Sequence[int]], joints: Sequence[Joint], count: int) -> None:
        self.columns = [list(column) for column in columns]
        self._before: list[list[tuple[int, float]]] = [[] for _ in range(count)]
        self._after: list[list[tuple[int, float]]] = [[] for _ in range(count)]
        self._place = [0] * count
        where = {item: number for number, column in enumerate(columns) for item in column}
        self._joints: list[list[Joint]] = [[] for _ in columns]
        for joint in joints:
            self._before[joint.target].append((joint.source, joint.leaves))
            self._after[joint.source].append((joint.target, joint.enters))
            self._joints[where[joint.source]].append(joint)
        for column in self.columns:
            self._number(column)

    def round(self, *, to_right: bool) -> None:
        """Sort every column by its neighbors on one side."""
        beside = self._before if to_right else self._after
        place = self._place
        for column in self.columns if to_right else reversed(self.columns):
            keys = {}
            for item in column:
                joined = beside[item]
                keys[item] = sum(place[i] + at for i, at in joined) / len(joined) if joined else place[item] + 0.5
            column.sort(key=keys.__getitem__)
            self._number(column)

    def crossings(self) -> int:
        place = self._place
        total = 0
        for joints in self._joints:
            ends = sorted((place[j.source] + j.leaves, place[j.target] + j.enters) for j in joints)
            total += inversions([end for _, end in ends])
        return total

    def _number(self, column: Sequence[int]) -> None:
        for place, item in enumerate(column):
            self._place[item] = place


def inversions(values: Sequence[float]) -> int:
    """How many pairs stand in falling order."""
    seen: list[float] = []
    found = 0
    for value in values:
        at = bisect_right(seen, value)
        found += len(seen) - at
        seen.insert(at, value)
    return found
