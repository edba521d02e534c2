"""One frame laid out as a graph of its own: its boxes and the frames in it, which are boxes by now, in columns.

The left border is a column before all others and the right border one behind them: a wire that enters or leaves the
frame passes it there.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import ceil

from graphface.report.drawing.bends import Chain, unbend
from graphface.report.drawing.boxes import Lane
from graphface.report.drawing.columns import Joint, ordered
from graphface.report.drawing.nesting import BORDER
from graphface.report.drawing.ranks import backward, ranks
from graphface.report.drawing.straight import Pull, straightened

PADDING = 16.0
_GAP, _GAP_PER_WIRE, _WIDEST_GAP = 34.0, 1.6, 110.0
_SPACE, _LANE_SPACE = 22.0, 9.0
_BENDS = {2: 8.0, 1: 2.0, 0: 1.0}
"""How much a joint wants to be straight, by how many of its ends are lanes: long wires before short ones."""


@dataclass(frozen=True)
class Passage:
    """A link with the heights where it leaves its source and enters its target, below their tops."""

    bundle: int
    source: int
    target: int
    leaves: float
    enters: float


@dataclass(frozen=True)
class Level:
    """A frame's inside, its top left corner at (0, 0).

    Attributes:
        places: left and top of every item. lanes: of every passage. back: whether it runs from right to left.
        entries, exits: how far down wires pass the left and right border, by bundle.
    """

    width: float
    height: float
    places: Sequence[tuple[float, float]]
    lanes: Sequence[tuple[Lane, ...]]
    back: Sequence[bool]
    entries: dict[int, float]
    exits: dict[int, float]


def arrange(sizes: Sequence[tuple[float, float]], passages: Sequence[Passage], top: float) -> Level:
    """Lay one frame out.

    Args:
        sizes: width and height of each item.
        passages: between items, by their place in `sizes`; BORDER is the frame's own.
        top: what to leave free above for the frame's title.
    """
    return _Arrangement(sizes, passages).level(top)


class _Arrangement:
    def __init__(self, sizes: Sequence[tuple[float, float]], passages: Sequence[Passage]) -> None:
        self._sizes = sizes
        self._passages = passages
        self._heights = [height for _, height in sizes]
        self._entries: dict[int, int] = {}
        self._exits: dict[int, int] = {}
        arrows = [(p.source, p.target) for p in passages if BORDER not in (p.source, p.target)]
        closing = backward(len(sizes), arrows) | {(a, b) for a, b in arrows if a == b}
        self._back = [(p.source, p.target) in closing for p in passages]
        forward = [arrow for arrow in arrows if arrow not in closing]
        own = ranks(len(sizes), forward + [(b, a) for a, b in closing if a != b and (b, a) not in closing])
        self._rank = [r + 1 for r in own]
        self._columns: list[list[int]] = [[] for _ in range(max(own, default=-1) + 3)]
        for item, rank in enumerate(self._rank):
            self._columns[rank].append(item)
        self._joints: dict[tuple[int, int, float, float], None] = {}
        self._shared: dict[tuple[int, ...], int] = {}
        self._chains: dict[tuple[int, int], Chain] = {}
        self._routes = [self._route(p, back) for p, back in zip(passages, self._back, strict=True)]

    def level(self, top: float) -> Level:
        """All steps in turn."""
        columns = ordered(self._columns, [self._joint(*j) for j in self._joints], len(self._heights))
        tops = self._tops(columns)
        highest = min((tops[item] for column in columns for item in column), default=0.0)
        tops = [round(t - highest + top, 1) for t in tops]
        lowest = max((tops[i] + self._heights[i] for column in columns for i in column), default=top)
        lefts, rights = self._sides(columns)
        places = []
        for item, (width, _) in enumerate(self._sizes):
            left, right = lefts[self._rank[item]], rights[self._rank[item]]
            places.append((round(left + (right - left - width) / 2, 1), tops[item]))
        lanes = [
            tuple(self._lanes(number, route, places, tops, lefts, rights)) for number, route in enumerate(self._routes)
        ]
        entries = {bundle: tops[item] for bundle, item in self._entries.items()}
        exits = {bundle: tops[item] for bundle, item in self._exits.items()}
        return Level(rights[-1], lowest + PADDING, places, lanes, self._back, entries, exits)

    def _route(self, passage: Passage, back: bool) -> list[int]:
        """The items that a passage runs through, lanes and borders included, joined on the way."""
        if back:
            return self._way_back(passage)
        last = len(self._columns) - 1
        source = self._border(self._entries, passage.bundle, 0) if passage.source == BORDER else passage.source
        target = self._border(self._exits, passage.bundle, last) if passage.target == BORDER else passage.target
        route, leaves = [source], passage.leaves
        known = self._chains.get((passage.bundle, source))
        for rank in range(self._rank[source] + 1, self._rank[target]):
            lane = self._lane((passage.bundle, source, rank), rank)
            self._joints[route[-1], lane, leaves, 0.0] = None
            route.append(lane)
            leaves = 0.0
        self._joints[route[-1], target, leaves, passage.enters] = None
        if len(route) > 1 and (known is None or len(known.lanes) < len(route) - 1):
            chain = Chain(route[1:], (source, passage.leaves), (target, passage.enters))
            self._chains[passage.bundle, source] = chain
        return [*route, target]

    def _way_back(self, passage: Passage) -> list[int]:
        """Beside the source, through every column to the left, beside the target."""
        first, last = self._rank[passage.target], self._rank[passage.source]
        key = (passage.bundle, passage.source, passage.target)
        lanes = [self._lane((*key, rank), rank) for rank in range(first, last + 1)]
        for left, right in pairwise(lanes):
            self._joints[left, right, 0.0, 0.0] = None
        return [passage.source, *reversed(lanes), passage.target]

    def _border(self, known: dict[int, int], bundle: int, rank: int) -> int:
        if bundle not in known:
            known[bundle] = self._add(rank)
        return known[bundle]

    def _lane(self, key: tuple[int, ...], rank: int) -> int:
        if key not in self._shared:
            self._shared[key] = self._add(rank)
        return self._shared[key]

    def _add(self, rank: int) -> int:
        self._heights.append(0.0)
        self._rank.append(rank)
        self._columns[rank].append(len(self._rank) - 1)
        return len(self._rank) - 1

    def _joint(self, source: int, target: int, leaves: float, enters: float) -> Joint:
        return Joint(source, target, self._share(source, leaves), self._share(target, enters))

    def _share(self, item: int, down: float) -> float:
        height = self._heights[item]
        return min(max(down / height, 0.0), 0.999) if height else 0.5

    def _tops(self, columns: Sequence[Sequence[int]]) -> list[float]:
        count, items = len(self._heights), len(self._sizes)
        before: list[list[Pull]] = [[] for _ in range(count)]
        after: list[list[Pull]] = [[] for _ in range(count)]
        for source, target, leaves, enters in self._joints:
            weight = _BENDS[(source >= items) + (target >= items)]
            before[target].append((source, leaves - enters, weight))
            after[source].append((target, enters - leaves, weight))
        spaces = [
            [_SPACE if a < items and b < items else _LANE_SPACE for a, b in pairwise(column)] for column in columns
        ]
        tops = straightened(columns, self._heights, spaces, before, after)
        unbend(list(self._chains.values()), columns, self._heights, spaces, tops)
        return tops

    def _sides(self, columns: Sequence[Sequence[int]]) -> tuple[list[float], list[float]]:
        """Where every column begins and ends; the gaps between are wider where more wires cross them."""
        crossing = [0] * len(columns)
        for source, _, _, _ in self._joints:
            crossing[self._rank[source]] += 1
        lefts, rights, x = [0.0], [0.0], PADDING + min(crossing[0] * _GAP_PER_WIRE, _WIDEST_GAP)
        for number in range(1, len(columns) - 1):
            width = ceil(max((self._sizes[i][0] for i in columns[number] if i < len(self._sizes)), default=0.0))
            lefts.append(round(x, 1))
            rights.append(round(x + width, 1))
            last = number == len(columns) - 2
            x += width + min((PADDING if last else _GAP) + crossing[number] * _GAP_PER_WIRE, _WIDEST_GAP)
        return [*lefts, round(x, 1)], [*rights, round(x, 1)]

    def _lanes(
        self,
        number: int,
        route: Sequence[int],
        places: Sequence[tuple[float, float]],
        tops: Sequence[float],
        lefts: Sequence[float],
        rights: Sequence[float],
    ) -> Iterator[Lane]:
        """The level pieces of a passage: out of its source's column, along its lanes, into its target's column."""
        passage, back = self._passages[number], self._back[number]
        source, target = route[0], route[-1]
        begins = places[source][0] + self._sizes[source][0] if source < len(self._sizes) else 0.0
        yield begins, rights[self._rank[source]], round(tops[source] + passage.leaves, 1)
        for lane in route[1:-1]:
            left, right = lefts[self._rank[lane]], rights[self._rank[lane]]
            yield (right, left, tops[lane]) if back else (left, right, tops[lane])
        ends = places[target][0] if target < len(self._sizes) else rights[-1]
        yield lefts[self._rank[target]], ends, round(tops[target] + passage.enters, 1)
