"""What has to hold of every layout, and random graphs with nesting to try it on."""

from collections.abc import Sequence
from itertools import pairwise

from hypothesis import strategies as st

from graphface.report.drawing.boxes import Box, Layout, Rect, Wire

_ROUNDED = 0.11
"""Pixels: places are rounded to tenths."""


def overlap(one: Rect, other: Rect) -> bool:
    """Whether two rectangles share more than an edge."""
    across = one.x < other.right and other.x < one.right
    return across and one.y < other.bottom and other.y < one.bottom


def inside(one: Rect, other: Rect) -> bool:
    """Whether `one` lies in `other`."""
    across = other.x <= one.x and one.right <= other.right
    return across and other.y <= one.y and one.bottom <= other.bottom


def check(placed: Layout, boxes: Sequence[Box], wires: Sequence[Wire]) -> None:
    """No overlap, frames around what is theirs and nothing else, wires from left to right and through no box."""
    whole = Rect(0, 0, placed.width, placed.height)
    rects = [*placed.boxes.items(), *placed.frames.items()]
    for place, (name, rect) in enumerate(rects):
        assert inside(rect, whole), name
        for other, second in rects[:place]:
            if other in placed.frames and name.startswith(f"{other}/"):
                assert inside(rect, second), (name, other)
            elif name in placed.frames and other.startswith(f"{name}/"):
                assert inside(second, rect), (other, name)
            else:
                assert not overlap(rect, second), (name, other)
    for number, wire in enumerate(wires):
        _check_wire(placed, wire, number)
    assert set(placed.boxes) == {b.name for b in boxes if not any(b.name.startswith(f"{f}/") for f in placed.folded)}


def _check_wire(placed: Layout, wire: Wire, number: int) -> None:
    lanes = placed.wires[number]
    source, target = (_shown(placed, name) for name in (wire.source, wire.target))
    if not lanes:
        assert source == target in placed.folded
        return
    begins, ends = _rect(placed, source), _rect(placed, target)
    assert abs(lanes[0][0] - begins.right) < _ROUNDED
    assert abs(lanes[-1][1] - ends.x) < _ROUNDED
    assert begins.y - _ROUNDED <= lanes[0][2] <= begins.bottom + _ROUNDED
    assert ends.y - _ROUNDED <= lanes[-1][2] <= ends.bottom + _ROUNDED
    if number not in placed.back:
        assert all(x0 <= x1 for x0, x1, _ in lanes)
        assert all(one[1] <= other[0] for one, other in pairwise(lanes))
    solid = [*placed.boxes.items(), *((f, placed.frames[f]) for f in placed.folded)]
    for x0, x1, y in lanes:
        left, right = sorted((x0, x1))
        for name, rect in solid:
            crossed = left + _ROUNDED < rect.right and rect.x < right - _ROUNDED and rect.y < y < rect.bottom
            assert not crossed, (wire, name)


def _shown(placed: Layout, name: str) -> str:
    return next((frame for frame in placed.folded if name.startswith(f"{frame}/")), name)


def _rect(placed: Layout, name: str) -> Rect:
    return placed.frames[name] if name in placed.folded else placed.boxes[name]


Nested = tuple[list[Box], list[Wire], dict[str, tuple[float, float]]]


@st.composite
def nested(draw: st.DrawFn) -> Nested:
    """Boxes of any size in frames, wires between any two of them, circles included, and some frames folded."""
    frames = [""]
    for number in range(draw(st.integers(0, 5))):
        frames.append(f"{draw(st.sampled_from(frames))}f{number}/")
    size = st.floats(1, 300).map(lambda value: round(value, 1))
    boxes = [
        Box(f"{draw(st.sampled_from(frames))}n{number}", draw(size), draw(size))
        for number in range(draw(st.integers(1, 14)))
    ]
    share = st.floats(0, 1)
    wires = []
    for _ in range(draw(st.integers(0, 30))):
        source, target = draw(st.sampled_from(boxes)), draw(st.sampled_from(boxes))
        down = round(draw(share) * source.height, 1), round(draw(share) * target.height, 1)
        wires.append(Wire(source.name, target.name, *down))
    used = {f for box in boxes for f in _around(box.name)}
    folded = draw(st.sets(st.sampled_from(sorted(used)))) if used else set()
    return boxes, wires, dict.fromkeys(sorted(folded), (90.0, 40.0))


def _around(name: str) -> list[str]:
    parts = name.split("/")[:-1]
    return ["/".join(parts[: depth + 1]) for depth in range(len(parts))]
