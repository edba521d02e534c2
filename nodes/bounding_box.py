"""The part of a picture that holds what is not 0."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Box = tuple[slice, slice]
"""Rows and columns of a picture: `values[box]` is that part of it."""


def bounding_box(mask: NDArray[Any], margin: int = 0) -> Box | None:
    """The smallest box around all values that are not 0, or None where there are none.

    Args:
        mask: H x W, of any dtype.
        margin: pixels that are added on each side, as far as the picture goes.

    >>> mask = np.zeros((10, 10))
    >>> mask[2:5, 7] = 1
    >>> bounding_box(mask)
    (slice(2, 5, None), slice(7, 8, None))
    >>> bounding_box(mask, margin=3)
    (slice(0, 8, None), slice(4, 10, None))
    """
    indices = [np.flatnonzero(mask.any(axis=axis)) for axis in (1, 0)]
    if indices[0].size == 0:
        return None
    rows, columns = (
        slice(max(0, int(index[0]) - margin), min(length, int(index[-1]) + 1 + margin))
        for index, length in zip(indices, mask.shape, strict=True)
    )
    return rows, columns
