"""What a layout is made of and what comes out of it. Lengths are in pixels, x to the right and y down."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

Lane = tuple[float, float, float]
"""A level piece of a wire: the x where it begins, the x where it ends, and y."""


@dataclass(frozen=True)
class Box:
    """Something to place. The name is a path: "face/mesh" stands in the frame "face"."""

    name: str
    width: float
    height: float


@dataclass(frozen=True)
class Wire:
    """From the right side of one box to the left side of another.

    `leaves` and `enters` are measured down from the top of the boxes. Wires that leave a box at the same height run
    together as far as they can.
    """

    source: str
    target: str
    leaves: float
    enters: float


@dataclass(frozen=True)
class Rect:
    x: float
    y: float
    width: float
    height: float

    @property
    def right(self) -> float:
        return self.x + self.width

    @property
    def bottom(self) -> float:
        return self.y + self.height


@dataclass(frozen=True)
class Layout:
    """Where everything stands.

    Attributes:
        boxes: by name, those inside a folded frame left out. frames: by path, folded ones included.
        wires: one for each given wire: the level pieces that it runs along, with curves between; none for a wire
            inside a folded frame.
        back: the numbers of the wires that run from right to left.
    """

    width: float
    height: float
    boxes: Mapping[str, Rect]
    frames: Mapping[str, Rect]
    folded: frozenset[str]
    wires: Sequence[tuple[Lane, ...]]
    back: frozenset[int]
