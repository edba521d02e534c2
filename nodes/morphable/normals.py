"""Normals of a triangle mesh."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.types import FloatArray


def vertex_normals(vertices: NDArray[np.float64], triangles: NDArray[np.int32], floor: float = 1e-12) -> FloatArray:
    """Unit normals float32 (V, 3): mean of the adjoining triangles' normals, weighted by their angle at the vertex.

    Angle weights make the normal independent of how a flat patch is cut into triangles (Thürmer and Wüthrich 1998). A
    vertex without any proper triangle looks at the viewer.
    """
    corners = vertices[triangles]
    ahead, back = np.roll(corners, -1, axis=1) - corners, np.roll(corners, 1, axis=1) - corners
    facing = np.cross(ahead[:, 0], back[:, 0])
    facing /= np.maximum(np.linalg.norm(facing, axis=1, keepdims=True), floor)
    lengths = np.linalg.norm(ahead, axis=2) * np.linalg.norm(back, axis=2)
    cosine = np.einsum("tkc,tkc->tk", ahead, back) / np.maximum(lengths, floor)
    angles = np.arccos(np.clip(cosine, -1, 1))
    normals = np.zeros_like(vertices)
    for k in range(3):
        np.add.at(normals, triangles[:, k], angles[:, k, None] * facing)
    length = np.linalg.norm(normals, axis=1, keepdims=True)
    return np.where(length > floor, normals / np.maximum(length, floor), (0, 0, 1)).astype(np.float32)
