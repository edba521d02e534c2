"""A problem solved on a small copy: reduce the photo, and upsample the result along the photo's edges."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.types import FloatArray

_RADIUS = 2
"""Pixels of the small copy."""


_EPSILON = 1e-4
"""The filter's regularization, in squared units of the guide."""


_SLOPES = (-1.0, 2.0)
"""Range of the local slope: log shading follows log intensity, or does not follow it at all."""


def reduced(values: FloatArray, longest: int) -> FloatArray:
    """A copy whose longer side has at most `longest` pixels, by the mean over areas; float32 h x w (x c)."""
    import cv2

    height, width = values.shape[:2]
    scale = longest / max(height, width)
    if scale >= 1:
        return values
    size = (max(1, round(width * scale)), max(1, round(height * scale)))
    return np.asarray(cv2.resize(values, size, interpolation=cv2.INTER_AREA), np.float32)


def upsampled(small: FloatArray, guide: FloatArray, full_guide: FloatArray) -> FloatArray:
    """A small map as a local linear function of the guide, evaluated with the guide at full size.

    He and Sun, Fast Guided Filter, 2015, algorithm 2. Where the small map follows an edge of the guide, the result
    follows the edge at full size; elsewhere it is smooth.

    Args:
        small, guide: float32 h x w. full_guide: float32 H x W.

    Returns:
        float32 H x W.
    """
    import cv2

    if small.shape == full_guide.shape:
        return small

    def box(x: NDArray[np.floating[Any]]) -> FloatArray:
        return np.asarray(cv2.blur(x, (2 * _RADIUS + 1,) * 2, borderType=cv2.BORDER_REPLICATE), np.float32)

    mean, mean_guide = box(small), box(guide)
    variance = np.maximum(box(guide * guide) - mean_guide * mean_guide, np.float32(0))
    slope = (box(small * guide) - mean * mean_guide) / (variance + np.float32(_EPSILON))
    slope = np.asarray(np.clip(slope, *_SLOPES), np.float32)
    size = (full_guide.shape[1], full_guide.shape[0])
    a, b = (
        np.asarray(cv2.resize(box(x), size, interpolation=cv2.INTER_LINEAR), np.float32)
        for x in (slope, mean - slope * mean_guide)
    )
    return a * full_guide + b
