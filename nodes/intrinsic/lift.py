"""Solving on a small copy: shrink the photo, and lift the small answer back to full size along the photo's edges."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.types import FloatArray


def shrunk(values: FloatArray, longest: int) -> FloatArray:
    """Area means in a copy whose longer side has at most `longest` pixels."""
    import cv2

    height, width = values.shape[:2]
    scale = longest / max(height, width)
    if scale >= 1:
        return values
    size = (max(1, round(width * scale)), max(1, round(height * scale)))
    return np.asarray(cv2.resize(values, size, interpolation=cv2.INTER_AREA), np.float32)


def lifted(small: FloatArray, guide: FloatArray, full_guide: FloatArray, *, radius: int = 2) -> FloatArray:
    """A small map as a local linear function of the guide, evaluated at full size.

    He and Sun, Fast Guided Filter, 2015. Where the small map follows an edge of the guide, the full one follows the
    full-size edge; where it does not, it stays smooth.

    Args:
        small, guide: h x w, of the same size. full_guide: H x W.
    """
    import cv2

    if small.shape == full_guide.shape:
        return small

    def box(x: NDArray[np.floating[Any]]) -> FloatArray:
        return np.asarray(cv2.blur(x, (2 * radius + 1,) * 2, borderType=cv2.BORDER_REPLICATE), np.float32)

    mean, mean_guide = box(small), box(guide)
    variance = np.maximum(box(guide * guide) - mean_guide * mean_guide, np.float32(0))
    slope = (box(small * guide) - mean * mean_guide) / (variance + np.float32(1e-4))
    slope = np.asarray(np.clip(slope, -1, 2), np.float32)  # log shading moves with log intensity, or not at all
    size = (full_guide.shape[1], full_guide.shape[0])
    a, b = (
        np.asarray(cv2.resize(box(x), size, interpolation=cv2.INTER_LINEAR), np.float32)
        for x in (slope, mean - slope * mean_guide)
    )
    return a * full_guide + b
