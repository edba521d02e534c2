"""The layouts that a page switches between when frames are folded and unfolded.

A layout takes milliseconds here and would be a second program in the page, so the page gets the layouts of every
combination that can be seen. Where those are too many it gets all open, all folded, and each frame alone folded.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from graphface.report.drawing.boxes import Layout, Rect
from graphface.report.drawing.curve import path
from graphface.report.drawing.figure import FOLDED, Figure
from graphface.report.drawing.layout import layout

_MOST = 48
_MOST_BOXES = 9000
"""Of all layouts together: it bounds the size of the page and the time to make it (about 3 s)."""


def states(drawn: Figure) -> Iterator[Layout]:
    """The layouts, that with everything open first."""
    boxes, wires = drawn.boxes, drawn.wires
    most = max(2, min(_MOST, _MOST_BOXES // max(len(boxes), 1)))
    for folded in foldings(_frames(drawn), most):
        yield layout(boxes, wires, dict.fromkeys(folded, FOLDED))


def foldings(frames: Sequence[str], most: int) -> list[frozenset[str]]:
    """At most so many sets of folded frames, none of them inside another: the empty set first, all folded last.

    Args:
        frames: paths, each after the frame around it.
        most: at least 2.
    """
    ways: dict[str, list[frozenset[str]]] = {frame: [frozenset()] for frame in ("", *frames)}
    for frame in reversed(frames):
        around = frame.rpartition("/")[0]
        folded = [*ways[frame], frozenset({frame})]
        if len(ways[around]) * len(folded) > most:
            return _few(frames, most)
        ways[around] = [one | other for one in ways[around] for other in folded]
    return ways[""]


def _few(frames: Sequence[str], most: int) -> list[frozenset[str]]:
    outermost = frozenset(frame for frame in frames if "/" not in frame)
    alone = [frozenset({frame}) for frame in frames[: most - 2]]
    return list(dict.fromkeys([frozenset(), *alone, outermost]))


def as_json(drawn: Figure, placed: Layout, frames: Sequence[str]) -> dict[str, Any]:
    """One layout as the page reads it: places in the order of the drawing's elements, None for what is hidden."""
    return {
        "folded": sorted(placed.folded),
        "size": [placed.width, placed.height],
        "nodes": [_corner(placed.boxes.get(node.name)) for node in drawn.nodes],
        "frames": [_sides(placed.frames.get(frame)) for frame in frames],
        "wires": [path(lanes) for lanes in placed.wires],
    }


def _frames(drawn: Figure) -> list[str]:
    """Every frame once, each after the one around it."""
    found: dict[str, None] = {}
    for node in drawn.nodes:
        parts = node.name.split("/")[:-1]
        for depth in range(len(parts)):
            found["/".join(parts[: depth + 1])] = None
    return list(found)


def _corner(rect: Rect | None) -> list[float] | None:
    return None if rect is None else [rect.x, rect.y]


def _sides(rect: Rect | None) -> list[float] | None:
    return None if rect is None else [rect.x, rect.y, rect.width, rect.height]
