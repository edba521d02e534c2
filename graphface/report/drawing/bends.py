"""Long wires with few bends: lanes in a row take one height where the items above and below leave room for it.

Least squares (`graphface.report.drawing.straight`) spreads what a wire has to climb over all columns, as stairs. Here
each wire is cut into as few level pieces as can be; everything else stays where it is.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import inf

_PASSES = 3
Interval = tuple[float, float]


@dataclass(frozen=True)
class Chain:
    """Lanes of one wire in neighboring columns; a port is an item and how far below its top a wire meets it."""

    lanes: Sequence[int]
    begins: tuple[int, float]
    ends: tuple[int, float]


def unbend(
    chains: Sequence[Chain],
    columns: Sequence[Sequence[int]],
    heights: Sequence[float],
    spaces: Sequence[Sequence[float]],
    tops: list[float],
) -> None:
    """Move the lanes in `tops`, keeping order and spacing; long chains first."""
    above: dict[int, tuple[int, float]] = {}
    below: dict[int, tuple[int, float]] = {}
    for column, space in zip(columns, spaces, strict=True):
        for upper, lower, between in zip(column, column[1:], space, strict=False):
            above[lower] = upper, between
            below[upper] = lower, between

    def free(lane: int) -> Interval:
        upper, lower = above.get(lane), below.get(lane)
        lowest = tops[upper[0]] + heights[upper[0]] + upper[1] if upper is not None else -inf
        return lowest, tops[lower[0]] - lower[1] if lower is not None else inf

    ordered = sorted(chains, key=lambda chain: -len(chain.lanes))
    for _ in range(_PASSES):
        for chain in ordered:
            begin, end = (tops[item] + down for item, down in (chain.begins, chain.ends))
            wanted = [tops[lane] for lane in chain.lanes]
            level = _level(begin, [free(lane) for lane in chain.lanes], end, wanted)
            for lane, height in zip(chain.lanes, level, strict=True):
                tops[lane] = height


def _level(begin: float, free: Sequence[Interval], end: float, wanted: Sequence[float]) -> Iterator[float]:
    """A height for each interval, the same for as many in a row as possible.

    The first piece goes on from `begin` and the last one to `end` where they can.
    """
    low = high = begin
    first = 0
    for number, (least, most) in enumerate([*free, (end, end)]):
        if max(low, least) <= min(high, most):
            low, high = max(low, least), min(high, most)
            continue
        yield from _piece(low, high, wanted[first:number])
        low, high, first = least, most, number
    yield from _piece(low, high, wanted[first:])


def _piece(low: float, high: float, wanted: Sequence[float]) -> list[float]:
    middle = sum(wanted) / len(wanted) if wanted else 0.0
    return [min(max(middle, low), high)] * len(wanted)
