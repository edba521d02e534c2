"""How the 468 points of FaceMesh hang together: triangles, mirror pairs and the mean shape, learned from faces.

The points come without a triangulation of ours to use, so one is computed: the mean of many frontal shapes is made
symmetric, unrolled about a vertical axis inside the head, and triangulated by Delaunay. Unrolling keeps the temples and
cheeks, steep in a frontal view, from degenerating into slivers; symmetry makes the triangulation its own mirror image,
so that a symmetric face gets symmetric normals. Eyes and mouth are covered.

`facemesh468.npz` beside this module is the result of

    points = np.stack([landmarks.points for landmarks in ...])   # 326 official headshots, one a person
    np.savez_compressed(path, **vars(learn_topology(points * [1, -1, 1])))
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

_FILE = Path(__file__).with_name("facemesh468.npz")


EYE_CORNERS = (33, 263)
"""Outer corners of the right and the left eye."""


FOREHEAD, CHIN = 10, 152
"""Points on the mid-line, at the top and at the bottom."""


_AXIS_DEPTH = -1.16
"""z of the axis that shapes are unrolled about, in inter-ocular distances behind the mean point."""


_LEAST_QUALITY = 0.25
"""Boundary triangles worse than this (1 is equilateral, 0 a line) lie in notches of the outline and are taken off."""


@dataclass(frozen=True)
class Topology:
    """What all faces share.

    `triangles` int32 (T, 3), counter-clockwise seen from outside; `mirror` int32 (468,): the point that each becomes
    in a mirror; `mean` float32 (468, 3): the mean shape, camera axes, inter-ocular distance 1, centred.
    """

    triangles: NDArray[np.int32]
    mirror: NDArray[np.int32]
    mean: NDArray[np.float32]


@cache
def facemesh_topology() -> Topology:
    """The topology of `landmarks.facemesh`, read once."""
    with np.load(_FILE, allow_pickle=False) as file:
        return Topology(file["triangles"], file["mirror"], file["mean"])


def learn_topology(shapes: NDArray[np.float64]) -> Topology:
    """Mean, mirror pairs and triangles of many shapes, (faces, 468, 3) in camera axes (y up), any pose and scale."""
    mean, mirror = _symmetric(_mean_shape(shapes))
    mean /= np.linalg.norm(mean[EYE_CORNERS[0]] - mean[EYE_CORNERS[1]])
    triangles = _triangulate(mean)
    return Topology(triangles.astype(np.int32), mirror.astype(np.int32), mean.astype(np.float32))


def cylinder(shape: NDArray[np.floating[Any]]) -> NDArray[np.float64]:
    """Texture coordinates (V, 2) in [0, 1] of a shape in this frame: unrolled about the axis inside the head, v up."""
    unrolled = _unrolled(np.asarray(shape, np.float64))
    low, high = unrolled.min(axis=0), unrolled.max(axis=0)
    coordinates: NDArray[np.float64] = (unrolled - low) / np.maximum(high - low, 1e-9)
    return coordinates


def _mean_shape(shapes: NDArray[np.float64], rounds: int = 5) -> NDArray[np.float64]:
    """Generalized Procrustes mean: shapes free of position, scale and rotation, averaged, repeatedly."""
    shapes = np.stack([_normalized(shape) for shape in shapes])
    mean = shapes[0]
    for _ in range(rounds):
        rotations = np.linalg.svd(np.einsum("fpi,pj->fij", shapes, mean))
        turned = shapes @ (rotations.U @ rotations.Vh)
        mean = _normalized(turned.mean(axis=0))
    across = mean[EYE_CORNERS[1]] - mean[EYE_CORNERS[0]]
    up = mean[FOREHEAD] - mean[CHIN]
    upright: NDArray[np.float64] = mean @ _frame(across, up)
    return upright


def _normalized(shape: NDArray[np.float64]) -> NDArray[np.float64]:
    centred = shape - shape.mean(axis=0)
    size = float(np.sqrt(np.square(centred).sum(axis=1).mean()))
    normalized: NDArray[np.float64] = centred / max(size, 1e-12)
    return normalized


def _frame(across: NDArray[np.float64], up: NDArray[np.float64]) -> NDArray[np.float64]:
    """The rotation whose columns are the unit vectors across, up made perpendicular, and towards the viewer."""
    x = across / max(float(np.linalg.norm(across)), 1e-12)
    y = up - x * (x @ up)
    y /= max(float(np.linalg.norm(y)), 1e-12)
    return np.stack([x, y, np.cross(x, y)], axis=1)


def _symmetric(shape: NDArray[np.float64], rounds: int = 15) -> tuple[NDArray[np.float64], NDArray[np.intp]]:
    """The shape made its own mirror image in x = 0, and its mirror pairs: assignment and plane found in turns."""
    from scipy.optimize import linear_sum_assignment

    flip = np.array([-1.0, 1.0, 1.0])
    mirror = np.arange(len(shape))
    for _ in range(rounds):
        shape = shape - shape.mean(axis=0)
        cost = np.square(shape[:, None] - (shape * flip)[None]).sum(axis=2)
        mirror = linear_sum_assignment(cost + cost.T)[1]
        # Differences between mirror points are all along the normal of the mirror's plane.
        across = np.linalg.svd(shape - shape[mirror])[2][0]
        shape = shape @ _frame(across * np.sign(across[0]), np.array([0.0, 1.0, 0.0]))
    symmetric = (shape + (shape * flip)[mirror]) / 2
    return symmetric - symmetric.mean(axis=0), mirror


def _triangulate(mean: NDArray[np.float64]) -> NDArray[np.intp]:
    """Delaunay triangles (T, 3) of the unrolled mean, counter-clockwise, without the slivers along its outline."""
    from scipy.spatial import Delaunay

    unrolled = _unrolled(mean)
    triangles: NDArray[np.intp] = Delaunay(unrolled).simplices
    a, b = (unrolled[triangles[:, k]] - unrolled[triangles[:, 0]] for k in (1, 2))
    clockwise = a[:, 0] * b[:, 1] < a[:, 1] * b[:, 0]
    triangles[clockwise] = triangles[clockwise][:, ::-1]
    while True:
        sliver = _on_boundary(triangles) & (_quality(mean[triangles]) < _LEAST_QUALITY)
        if not sliver.any():
            return triangles
        triangles = triangles[~sliver]


def _unrolled(shape: NDArray[np.float64]) -> NDArray[np.float64]:
    """Angle about the vertical axis, and height: (V, 2)."""
    return np.stack([np.arctan2(shape[:, 0], shape[:, 2] - _AXIS_DEPTH), shape[:, 1]], axis=1)


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
