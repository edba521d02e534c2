"""Which pixels of two arrays differ, at the size of a picture: none is lost, however small the picture is."""

from __future__ import annotations

from io import BytesIO
from typing import Any

import numpy as np
from numpy.typing import NDArray

_COLOR = (255, 40, 30)


def differing(one: NDArray[Any], other: NDArray[Any], size: tuple[int, int]) -> NDArray[np.bool_] | None:
    """The places where any value of a block differs, height x width; None for arrays that are no maps of one size.

    Args:
        size: height and width at the most; no axis gets longer than that of the arrays.
    """
    if one.shape != other.shape or one.ndim not in (2, 3) or not one.size:
        return None
    with np.errstate(invalid="ignore"):
        apart = (one != other) & ~((one != one) & (other != other))
    found = apart if apart.ndim == 2 else apart.any(axis=2)
    for axis, wanted in enumerate(size):
        length = found.shape[axis]
        edges = (np.arange(min(wanted, length)) * length / min(wanted, length)).astype(np.intp)
        found = np.logical_or.reduceat(found, edges, axis=axis)
    return np.asarray(found)


def as_png(mask: NDArray[np.bool_]) -> bytes:
    """Red where something differs, transparent elsewhere: a PNG of one bit a pixel."""
    from PIL import Image

    image = Image.fromarray(mask.astype(np.uint8), "P")
    image.putpalette([0, 0, 0, *_COLOR])
    stream = BytesIO()
    image.save(stream, "PNG", bits=1, transparency=0, optimize=False)
    return stream.getvalue()
