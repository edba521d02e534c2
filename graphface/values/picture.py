"""How values are looked at: one function for each type draws its values, and whoever shows values asks for it.

A drawing is said beside the type, not in it: in `Pack.pictures` of an installed pack, in `PICTURES` of a plug-in file,
or in a notebook through `Registry.add_picture`:

    def draw_curve(curve: Curve, view: View) -> Picture:
        return Picture(plotted(curve), note="black is 0, white is 1")

    PICTURES = {Curve: draw_curve}

Numbers, texts, plain arrays, lists and the fields of records need none: the engine draws them (`graphface.pictures`).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphface.values.port_types import Atom


@dataclass(frozen=True, eq=False)
class Picture:
    """A value as people see it.

    Attributes:
        pixels: uint8 H x W x 3, sRGB.
        note: what the colors mean, with the scale: "mid grey is 0, white is 0.25".
        data: the value under each pixel, H x W or H x W x C of numbers or booleans, for reading it with a cursor; None
            where a pixel has no single value (a diagram).
        channels: a name for each channel of `data`.
        full: height and width of the array that `data` was sampled from (`View.sampled`); those of `data` if None.
    """

    pixels: NDArray[np.uint8]
    note: str = ""
    data: NDArray[Any] | None = None
    channels: tuple[str, ...] = ()
    full: tuple[int, int] | None = None


def _nothing_above(kind: Atom) -> Any:
    return None


@dataclass(frozen=True)
class View:
    """What a drawing may use beside its value.

    Attributes:
        size: pixels of the picture's longer side, at the most; None for all that the value has.
        above: from a type to the nearest value of it among those that the drawn value was made from (the photo that a
            mask belongs to), or None.
    """

    size: int | None = None
    above: Callable[[Atom], Any] = _nothing_above

    def sampled(self, array: NDArray[Any]) -> NDArray[Any]:
        """Every n-th row and column of H x W or H x W x C, so that the longer side has at most `size`.

        Rows and columns are picked, never averaged: what is shown is a value that the array holds. Row i of h stands
        for row floor((i + 1/2) H / h) of H.
        """
        longest = max(array.shape[:2], default=0)
        if self.size is None or longest <= self.size:
            return array
        rows, columns = (picked(n, max(1, round(n * self.size / longest))) for n in array.shape[:2])
        return array.take(rows, axis=0).take(columns, axis=1)


def picked(length: int, count: int) -> NDArray[np.intp]:
    """The `count` indices that stand for `length`: each the middle of its share."""
    return ((np.arange(count) + 0.5) * length / count).astype(np.intp)


Draw = Callable[[Any, View], Picture]
"""From a value to its picture. Raises nothing for a value that its type can have."""
