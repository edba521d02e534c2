"""The FaceMesh points on a face mesh, and the head's pose by them."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.morphable.topology import facemesh_topology
from graphface.nodes.types import Mesh

Points = NDArray[np.float64]


_LEAST_POINTS = 100
"""FaceMesh points that must be known on a mesh to estimate the head's pose."""


_LARGEST_DISTANCE = 0.2
"""Root mean square distance from the posed mean face, in its unit, above which points are not those of FaceMesh."""


def face_points(mesh: Mesh) -> Points:
    """The 468 points of FaceMesh on a mesh, (468, 3); NaN where the mesh does not know them."""
    face = np.full(facemesh_topology().mean.shape, np.nan)
    if mesh.facemesh is not None and len(mesh.facemesh) == len(face):
        known = (mesh.facemesh >= 0) & (mesh.facemesh < len(mesh.vertices))
        face[known] = mesh.vertices[mesh.facemesh[known]]
    return face


def head_pose(points: Points, reference: NDArray[np.floating[Any]]) -> tuple[Points, float, Points] | None:
    """Rotation, scale and origin that take a face of known position (n, 3) to its `points` (n, 3).

    Umeyama, Least-Squares Estimation of Transformation Parameters Between Two Point Patterns, TPAMI 1991, equations
    40 to 42. None where they are not the points of a face.
    """
    if len(points) < _LEAST_POINTS:
        return None
    reference = reference.astype(np.float64)
    reference_middle, middle = reference.mean(axis=0), points.mean(axis=0)
    u, singular, vt = np.linalg.svd((points - middle).T @ (reference - reference_middle))
    sign = np.array([1, 1, np.sign(np.linalg.det(u @ vt)) or 1.0])
    rotation = (u * sign) @ vt
    scale = float((singular * sign).sum() / max(np.square(reference - reference_middle).sum(), 1e-12))
    if scale <= 1e-6:
        return None
    misfit = (points - middle) / scale - (reference - reference_middle) @ rotation.T
    if float(np.sqrt(np.square(misfit).sum(axis=1).mean())) > _LARGEST_DISTANCE:
        return None
    return rotation, scale, middle - scale * rotation @ reference_middle
