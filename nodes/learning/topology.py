"""The topology of FaceMesh's 468 points, learned from faces: triangles, mirror pairs and the mean shape.

FaceMesh's own triangulation is not at our disposal, so one is computed. The mean of many frontal shapes is made
symmetric, unrolled about a vertical axis inside the head, and triangulated (Delaunay). Unrolling avoids slivers at the
temples and cheeks, which are steep in a frontal view. Symmetry makes the triangulation its own mirror image, so that a
symmetric face has symmetric normals. Eyes and mouth are covered.

`nodes/morphable/facemesh468.npz` is the result of

    points = np.stack([landmarks.points for landmarks in ...])   # 326 official headshots, one per person
    np.savez_compressed(path, **vars(learn_topology(points * [1, -1, 1])))
"""

from __future__ import annotations

from collections import Counter

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.morphable.topology import CHIN, EYE_CORNERS, FOREHEAD, Topology, unrolled

_LEAST_QUALITY = 0.25
"""Boundary triangles of a lower quality (1 is equilateral, 0 a line) lie in notches of the outline and are removed."""


def learn_topology(shapes: NDArray[np.float64]) -> Topology:
    """Mean, mirror pairs and triangles of many shapes, (faces, 468, 3) in camera axes (y up), of any pose and scale."""
    mean, mirror = _symmetric(_mean_shape(shapes))
    mean /= np.linalg.norm(mean[EYE_CORNERS[0]] - mean[EYE_CORNERS[1]])
    triangles = _triangulate(mean)
    return Topology(triangles.astype(np.int32), mirror.astype(np.int32), mean.astype(np.float32))


def _mean_shape(shapes: NDArray[np.float64], rounds: int = 5) -> NDArray[np.float64]:
    """Generalized Procrustes mean: shapes aligned to their mean by rotation, scale and position, repeatedly."""
    shapes = np.stack([_normalized(shape) for shape in shapes])
    mean = shapes[0]
    for _ in range(rounds):
        rotations = np.linalg.svd(np.einsum("fpi,pj->fij", shapes, mean))
        rotated = shapes @ (rotations.U @ rotations.Vh)
        mean = _normalized(rotated.mean(axis=0))
    across = mean[EYE_CORNERS[1]] - mean[EYE_CORNERS[0]]
    up = mean[FOREHEAD] - mean[CHIN]
    upright: NDArray[np.float64] = mean @ _frame(across, up)
    return upright


def _normalized(shape: NDArray[np.float64]) -> NDArray[np.float64]:
    centered = shape - shape.mean(axis=0)
    size = float(np.sqrt(np.square(centered).sum(axis=1).mean()))
    normalized: NDArray[np.float64] = centered / max(size, 1e-12)
    return normalized


def _frame(across: NDArray[np.float64], up: NDArray[np.float64]) -> NDArray[np.float64]:
    """The rotation whose columns are the unit vectors across, up made perpendicular, and towards the viewer."""
    x = across / max(float(np.linalg.norm(across)), 1e-12)
    y = up - x * (x @ up)
    y /= max(float(np.linalg.norm(y)), 1e-12)
    return np.stack([x, y, np.cross(x, y)], axis=1)


def _symmetric(shape: NDArray[np.float64], rounds: int = 15) -> tuple[NDArray[np.float64], NDArray[np.intp]]:
    """The shape made symmetric about x = 0, and its mirror pairs; pairs and plane are estimated alternately."""
    from scipy.optimize import linear_sum_assignment

    flip = np.array([-1.0, 1.0, 1.0])
    mirror = np.arange(len(shape))
    for _ in range(rounds):
        shape = shape - shape.mean(axis=0)
        cost = np.square(shape[:, None] - (shape * flip)[None]).sum(axis=2)
        mirror = linear_sum_assignment(cost + cost.T)[1]
        # Differences between mirror points are parallel to the normal of the mirror plane.
        across = np.linalg.svd(shape - shape[mirror])[2][0]
        shape = shape @ _frame(across * np.sign(across[0]), np.array([0.0, 1.0, 0.0]))
    symmetric = (shape + (shape * flip)[mirror]) / 2
    return symmetric - symmetric.mean(axis=0), mirror


def _triangulate(mean: NDArray[np.float64]) -> NDArray[np.intp]:
    """Delaunay triangles (T, 3) of the unrolled mean, counter-clockwise, without slivers along its outline."""
    from scipy.spatial import Delaunay

    flat = unrolled(mean)
    triangles: NDArray[np.intp] = Delaunay(flat).simplices
    a, b = (flat[triangles[:, k]] - flat[triangles[:, 0]] for k in (1, 2))
    clockwise = a[:, 0] * b[:, 1] < a[:, 1] * b[:, 0]
    triangles[clockwise] = triangles[clockwise][:, ::-1]
    while True:
        sliver = _on_boundary(triangles) & (_quality(mean[triangles]) < _LEAST_QUALITY)
        if not sliver.any():
            return triangles
        triangles = triangles[~sliver]


def _on_boundary(triangles: NDArray[np.intp]) -> NDArray[np.bool_]:
    edges = [[tuple(sorted((t[k], t[k - 1]))) for k in range(3)] for t in triangles.tolist()]
    uses = Counter(edge for sides in edges for edge in sides)
    return np.array([any(uses[edge] == 1 for edge in sides) for sides in edges])


def _quality(corners: NDArray[np.float64]) -> NDArray[np.float64]:
    """1 for an equilateral triangle, towards 0 for a line; corners are (T, 3, 3)."""
    sides = np.square(corners - np.roll(corners, 1, axis=1)).sum(axis=(1, 2))
    area = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) / 2
    quality: NDArray[np.float64] = 4 * np.sqrt(3) * area / np.maximum(sides, 1e-12)
    return quality
