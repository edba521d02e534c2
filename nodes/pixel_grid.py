"""Points in the camera frame for the pixels of a picture, and regular grids of pixels."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.types import Camera, FloatArray


def lifted_pixels(u: NDArray[np.intp], v: NDArray[np.intp], depth: FloatArray, camera: Camera) -> FloatArray:
    """Camera-frame points (n, 3) at pixels (u, v) with the given z: the inverse of `Camera.project`.

    >>> lifted_pixels(np.array([7]), np.array([1]), np.float32([2]), Camera(center=(4, 3))).tolist()
    [[3.0, 2.0, 2.0]]
    """
    stretch = np.maximum(1 - depth * camera.nearness, 1e-3) / max(camera.scale, 1e-9)
    x, y = (u - camera.center[0]) * stretch, (camera.center[1] - v) * stretch
    return np.stack([x, y, depth], axis=1).astype(np.float32)


def grid_middles(length: int, scale: float) -> NDArray[np.intp]:
    """The middle pixels of equal intervals, `scale` intervals per pixel; every pixel where `scale` is 1 or more.

    >>> grid_middles(9, 1 / 3).tolist()
    [1, 4, 7]
    """
    if scale >= 1:
        return np.arange(length)
    parts = max(1, round(length * scale))
    return ((np.arange(parts) + 0.5) * (length / parts)).astype(np.intp)
