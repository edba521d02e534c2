"""Simple shapes with known answers: two eye corners without a face, a half ball."""

from __future__ import annotations

import numpy as np

from graphface.nodes.types import FloatArray, Landmarks, Surface


def eyes_apart(interocular: float) -> Landmarks:
    """Landmarks of which only the outer eye corners have a place, `interocular` pixels apart."""
    points = np.zeros((468, 3), np.float32)
    points[263, 0] = interocular
    return Landmarks(points, "facemesh468")


def half_ball(side: int = 33) -> FloatArray:
    """The normals of a half ball seen from the front, side x side x 3; zero beside it."""
    y, x = np.mgrid[1 : -1 : side * 1j, -1 : 1 : side * 1j]
    squared = x * x + y * y
    normals = np.stack([x, y, np.sqrt(np.maximum(1 - squared, 0))], axis=2)
    normals[squared >= 1] = 0
    return normals.astype(np.float32)


def surface_with(normals: FloatArray, depth: FloatArray | None = None) -> Surface:
    """A surface wherever normals H x W x 3 are not zero; all of it is triangle 0."""
    covered = normals.any(axis=2)
    depth = np.zeros(covered.shape, np.float32) if depth is None else depth
    triangle = np.where(covered, 0, -1).astype(np.int32)
    return Surface(normals, depth, covered.astype(np.float32), triangle, np.zeros_like(normals))
