"""Pictures of values, and the part of them worth looking at."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphface.pictures import draw
from graphface.registry import Registry, default_registry
from graphface.values.port_types import PortType

Picture = NDArray[np.uint8]
Box = tuple[int, int, int, int]
"""Left, top, width, height in pixels."""

GAIN = 4
"""By which difference maps are amplified; mid grey is no difference."""


def picture_of(value: Any, declared: PortType, registry: Registry | None = None) -> Picture:
    """A value drawn as its type is, in all its pixels, uint8 H x W x 3.

    Args:
        registry: where drawings are found; that of everything installed by default.
    """
    return draw(value, declared, registry if registry is not None else default_registry()).pixels


def difference(one: Picture, other: Picture) -> Picture:
    """Mid grey where two pictures of one size agree; lighter where `one` is, times `GAIN`."""
    if one.shape != other.shape:
        return np.full_like(one, 128)
    signed = (one.astype(np.int16) - other.astype(np.int16)) * GAIN + 128
    return np.clip(signed, 0, 255).astype(np.uint8)


def cropped(picture: Picture, box: Box | None) -> Picture:
    if box is None:
        return picture
    left, top, width, height = box
    return picture[top : top + height, left : left + width]


def where_they_differ(pictures: Sequence[Picture], share: float = 0.45) -> Box | None:
    """The square, `share` of the shorter side wide, that holds most of the spread between pictures of one size."""
    shapes = {picture.shape for picture in pictures}
    if len(shapes) != 1 or len(pictures) < 2:
        return None
    height, width = pictures[0].shape[:2]
    side = max(1, round(share * min(height, width)))
    stack = np.stack([p.astype(np.float32).mean(axis=2) for p in pictures])
    spread = np.pad(np.cumsum(np.cumsum(stack.max(axis=0) - stack.min(axis=0), axis=0), axis=1), ((1, 0), (1, 0)))
    if spread[-1, -1] <= 0:
        return None
    sums = spread[side:, side:] - spread[:-side, side:] - spread[side:, :-side] + spread[:-side, :-side]
    top, left = np.unravel_index(int(sums.argmax()), sums.shape)
    return int(left), int(top), side, side
