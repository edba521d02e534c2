"""Texture coordinates as positions of texels, and values there."""

from __future__ import annotations

import cv2
import numpy as np

from graphface.nodes.types import FloatArray


def sampled(values: FloatArray, places: FloatArray) -> FloatArray:
    """Values at positions (x, y) in texels, H x W x 2: bilinear interpolation, the border repeats."""
    # With places in one map OpenCV wants None for the other, which its type stubs do not know.
    found = cv2.remap(values, places, None, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)  # type: ignore[call-overload]
    return np.asarray(found, np.float32)


def texels(uv: FloatArray, size: int) -> FloatArray:
    """Positions (x, y) in texels, y down, of texture coordinates (u, v), v up; integers are texel centres.

    >>> texels(np.float32([[0, 1], [0.5, 0.5]]), 4)  # the corner of the first texel, the middle of the texture
    array([[-0.5, -0.5],
           [ 1.5,  1.5]], dtype=float32)
    """
    places: FloatArray = (np.stack([uv[..., 0], 1 - uv[..., 1]], axis=-1) * size - 0.5).astype(np.float32)
    return places
