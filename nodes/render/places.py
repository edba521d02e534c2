"""Where the points lie that the camera sees, in face units."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.types import Camera, FloatArray, Mesh, Surface


def points_seen(mesh: Mesh, surface: Surface, scale: float = 1.0) -> tuple[FloatArray, FloatArray, NDArray[np.bool_]]:
    """Points and unit normals of the surface, one per covered pixel of a grid `scale` times as fine as the picture.

    Returns:
        points (n, 3) in the camera frame, inter-ocular distances; normals (n, 3); covered, bool, the grid's h x w.
    """
    height, width = surface.coverage.shape
    rows, columns = (grid_middles(n, scale) for n in (height, width))
    grid = np.ix_(rows, columns)
    covered = surface.coverage[grid] > 0
    down, across = np.nonzero(covered)
    v, u = rows[down], columns[across]
    points = lifted_pixels(u, v, surface.depth[v, u], mesh.camera)
    points *= np.float32(1 / max(mesh.interocular, 1e-3))
    return points, surface.normals[v, u], covered


def surface_points(covered: NDArray[np.bool_], surface: Surface, mesh: Mesh) -> FloatArray:
    """The camera-frame points (n, 3) of some pixels of the surface, inter-ocular distances."""
    v, u = np.nonzero(covered)
    return lifted_pixels(u, v, surface.depth[v, u], mesh.camera) / np.float32(max(mesh.interocular, 1e-3))


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
