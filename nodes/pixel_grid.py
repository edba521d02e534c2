"""Where the points lie that the camera sees, in face units."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.types import Camera, FloatArray


def lifted_pixels(u: NDArray[np.intp], v: NDArray[np.intp], depth: FloatArray, camera: Camera) -> FloatArray:
    """The camera-frame points (n, 3) at pixels (u, v) with the given z: the inverse of `Camera.project`."""
    stretch = np.maximum(1 - depth * camera.nearness, 1e-3) / max(camera.scale, 1e-9)
    x, y = (u - camera.center[0]) * stretch, (camera.center[1] - v) * stretch
    return np.stack([x, y, depth], axis=1).astype(np.float32)


def grid_middles(length: int, scale: float) -> NDArray[np.intp]:
    """The pixels in the middle of equal stretches, `scale` of them a pixel; all where that is 1 or more."""
    if scale >= 1:
        return np.arange(length)
    parts = max(1, round(length * scale))
    return ((np.arange(parts) + 0.5) * (length / parts)).astype(np.intp)
