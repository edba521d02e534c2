"""Polygons drawn as masks, and masks grown and shrunk by a radius."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.head_shape import Points
from graphface.nodes.types import FloatArray


def filled(polygons: Iterable[Points], shape: tuple[int, ...]) -> FloatArray:
    """A mask H x W that is 1 inside any of the convex polygons (n, 2), in pixels, and 0 outside.

    Parts beyond the frame are cut; a polygon smaller than a pixel still sets one. A polygon that is not finite is left
    out.
    """
    import cv2

    canvas = np.zeros(shape[:2], np.uint8)
    for polygon in polygons:
        if len(polygon) and np.isfinite(polygon).all() and np.abs(polygon).max() < 1 << 20:
            cv2.fillConvexPoly(canvas, np.round(polygon * 16).astype(np.int32), 1, cv2.LINE_8, 4)
    return canvas.astype(np.float32)


def eroded(mask: FloatArray, radius: float) -> FloatArray:
    """The part of a mask of 0 and 1 that lies more than `radius` pixels inside; the frame is no edge.

    >>> eroded(np.float32([[0, 1, 1, 1, 1]]), 2.5)
    array([[0., 0., 0., 1., 1.]], dtype=float32)
    """
    return (_distance_within(mask > 0.5) > radius).astype(np.float32)


def dilated(mask: FloatArray, radius: float) -> FloatArray:
    """A mask of 0 and 1 grown by `radius` pixels.

    >>> dilated(np.float32([[0, 0, 0, 0, 1]]), 2.5)
    array([[0., 0., 1., 1., 1.]], dtype=float32)
    """
    return ((mask > 0.5) | ((_distance_within(mask <= 0.5) <= radius) & mask.any())).astype(np.float32)


def _distance_within(inside: NDArray[np.bool_]) -> FloatArray:
    """Distance of each inside pixel to the nearest one that is outside; 1e9 where there is none."""
    import cv2

    if inside.all():
        return np.full(inside.shape, 1e9, np.float32)
    return np.asarray(cv2.distanceTransform(inside.astype(np.uint8), cv2.DIST_L2, 5), np.float32)
