"""A wire's level pieces as one smooth line."""

from __future__ import annotations

from collections.abc import Sequence

from graphface.report.drawing.boxes import Lane

_TURN = 14.0
"""How far a wire that turns round swings out."""
Point = tuple[float, float]
Cubic = tuple[Point, Point, Point]


def curved(lanes: Sequence[Lane]) -> tuple[Point, list[Cubic | Point]]:
    """Where the wire begins, then in turn the ends of straight pieces and the cubic curves between them.

    Args:
        lanes: at least one.
    """
    start = lanes[0][0], lanes[0][2]
    parts: list[Cubic | Point] = []
    for number, (begins, ends, y) in enumerate(lanes):
        if number:
            parts.append(_bend(lanes[number - 1], lanes[number]))
        if ends != begins:
            parts.append((ends, y))
    return start, parts


def path(lanes: Sequence[Lane]) -> str:
    """The wire as the `d` of an SVG path; empty where there are no lanes."""
    if not lanes:
        return ""
    (x, y), parts = curved(lanes)
    words = [f"M{x:g} {y:g}"]
    for part in parts:
        if isinstance(part[0], tuple):
            words.append("C" + " ".join(f"{a:g} {b:g}" for a, b in part))
        else:
            words.append(f"H{part[0]:g}")
    return "".join(words)


def _bend(one: Lane, other: Lane) -> Cubic:
    (begins, x0, y0), (x1, ends, y1) = one, other
    leaving, arriving = _direction(begins, x0), _direction(x1, ends)
    if leaving > 0 and arriving > 0 and x1 >= x0:
        middle = (x0 + x1) / 2
        return (middle, y0), (middle, y1), (x1, y1)
    reach = max(abs(x1 - x0) / 2, _TURN)
    return (x0 + leaving * reach, y0), (x1 - arriving * reach, y1), (x1, y1)


def _direction(begins: float, ends: float) -> int:
    return -1 if ends < begins else 1
