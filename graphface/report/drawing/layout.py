"""A layered layout with frames: each frame is laid out as a graph of its own and is then a box in the frame around it.

From the inside out: the innermost frames first, since the others need their sizes. A wire passes the border of a frame
at a fixed height, where the frame around it takes it up. Nothing overlaps, by construction: items of a column stand
below one another, columns beside each other, and lanes keep wires out of what they pass.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import ceil

from graphface.report.drawing.boxes import Box, Lane, Layout, Rect, Wire
from graphface.report.drawing.level import Level, Passage, arrange
from graphface.report.drawing.nesting import BORDER, Link, Nesting

TITLE = 30.0
"""What a frame leaves free above its boxes for its title."""
_MARGIN = 16.0
_ROUNDED = 0.11
"""How far two places may differ that are the same before they are rounded."""


def layout(boxes: Sequence[Box], wires: Sequence[Wire], folded: Mapping[str, tuple[float, float]] = {}) -> Layout:
    """Place boxes and wires.

    Args:
        boxes: no two of one name. A name with slashes is a path, "face/mesh" a box in the frame "face".
        wires: between boxes by name.
        folded: frames that are drawn as one box, with the size of that box.
    """
    nesting = Nesting(boxes, wires, folded)
    return _Placing(nesting, boxes, folded).layout()


class _Placing:
    def __init__(self, nesting: Nesting, boxes: Sequence[Box], folded: Mapping[str, tuple[float, float]]) -> None:
        self._nesting = nesting
        self._boxes = boxes
        self._sizes = {number: (box.width, box.height) for number, box in enumerate(boxes)}
        self._sizes |= {number: folded[nesting.frames[number].path] for number in nesting.folded}
        self._levels: dict[int, Level] = {}
        self._numbers: dict[int, dict[Link, int]] = {}

    def layout(self) -> Layout:
        nesting = self._nesting
        for number in reversed(nesting.frames):
            if number not in nesting.folded:
                self._levels[number] = self._arrange(number)
                self._sizes[number] = self._levels[number].width, self._levels[number].height
        corners = self._corners()
        rects = {number: Rect(*corner, *self._sizes[number]) for number, corner in corners.items()}
        width, height = self._sizes[nesting.root]
        wires = [self._wire(hops, corners) for hops in nesting.hops]
        back = {
            number
            for number, hops in enumerate(nesting.hops)
            if any(self._levels[frame].back[self._numbers[frame][link]] for frame, link in hops)
        }
        return Layout(
            ceil(width),
            ceil(height),
            {box.name: rects[number] for number, box in enumerate(self._boxes) if number in rects},
            {frame.path: rects[number] for number, frame in nesting.frames.items() if number != nesting.root},
            frozenset(nesting.frames[number].path for number in nesting.folded),
            wires,
            frozenset(back),
        )

    def _arrange(self, number: int) -> Level:
        frame = self._nesting.frames[number]
        local = {child: place for place, child in enumerate(frame.children)} | {BORDER: BORDER}
        self._numbers[number] = {link: place for place, link in enumerate(frame.links)}
        passages = [
            Passage(link.bundle, local[link.source], local[link.target], self._leaves(link), self._enters(link))
            for link in frame.links
        ]
        top = _MARGIN if number == self._nesting.root else TITLE
        return arrange([self._sizes[child] for child in frame.children], passages, top)

    def _leaves(self, link: Link) -> float:
        """How far below the top of its source a link begins."""
        if link.source == BORDER:
            return 0.0
        if link.source in self._levels:
            return self._levels[link.source].exits[link.bundle]
        return self._port(link.source, self._nesting.bundles[link.bundle][1])

    def _enters(self, link: Link) -> float:
        if link.target == BORDER:
            return 0.0
        if link.target in self._levels:
            return self._levels[link.target].entries[link.bundle]
        return self._port(link.target, link.enters)

    def _port(self, number: int, height: float) -> float:
        """Where a wire meets a box; a folded frame is met in its middle."""
        return self._sizes[number][1] / 2 if number in self._nesting.folded else height

    def _corners(self) -> dict[int, tuple[float, float]]:
        corners = {self._nesting.root: (0.0, 0.0)}
        for number, level in reversed(self._levels.items()):
            x, y = corners[number]
            for child, (left, top) in zip(self._nesting.frames[number].children, level.places, strict=True):
                corners[child] = round(x + left, 1), round(y + top, 1)
        return corners

    def _wire(self, hops: Sequence[tuple[int, Link]], corners: Mapping[int, tuple[float, float]]) -> tuple[Lane, ...]:
        lanes: list[Lane] = []
        for frame, link in hops:
            x, y = corners[frame]
            for begins, ends, down in self._levels[frame].lanes[self._numbers[frame][link]]:
                lane = (round(x + begins, 1), round(x + ends, 1), round(y + down, 1))
                if lanes and _go_on(lanes[-1], lane):
                    lane = (lanes.pop()[0], *lane[1:])
                lanes.append(lane)
        return tuple(lanes)


def _go_on(one: Lane, other: Lane) -> bool:
    """Whether two pieces of a wire are one line to the right."""
    return one[2] == other[2] and one[0] <= one[1] <= other[0] + _ROUNDED and other[0] <= other[1]
