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


def states(drawn: Figure) -> Iterator[Layout]:
    """The layouts, that with everything open first."""
    boxes, wires = drawn.boxes, drawn.wires
    for folded in foldings(_frames(drawn)):
        yield layout(boxes, wires, dict.fromkeys(folded, FOLDED))


def foldings(frames: Sequence[str]) -> list[frozenset[str]]:
    """Sets of folded frames, none of them inside another; the empty set first.

    Args:
        frames: paths, each after the frame around it.
    """
    around = {frame: frame.rpartition("/")[0] for frame in frames}
    ways: dict[str, list[frozenset[str]]] = {frame: [frozenset()] for frame in ("", *frames)}
    for frame in (*reversed(frames), ""):
        inside = [child for child in frames if around[child] == frame]
        for child in inside:
            folded = [*ways[child], frozenset({child})]
            if len(ways[frame]) * len(folded) > _MOST:
                return _few(frames, around)
            ways[frame] = [one | other for one in ways[frame] for other in folded]
    return ways[""]


def _few(frames: Sequence[str], around: dict[str, str]) -> list[frozenset[str]]:
    outermost = frozenset(frame for frame in frames if not around[frame])
    alone = [frozenset({frame}) for frame in frames[: _MOST - 2]]
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
