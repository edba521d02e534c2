"""Normals of a triangle mesh."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.types import FloatArray


def vertex_normals(vertices: NDArray[np.float64], triangles: NDArray[np.int32], floor: float = 1e-12) -> FloatArray:
    """Unit normals float32 (V, 3): means of the adjoining triangles' normals, weighted by their angles at the vertex.

    Angle weights make the normal independent of the triangulation of a flat patch (Thürmer and Wüthrich 1998). A vertex
    without a proper triangle has the normal (0, 0, 1).
    """
    corners = vertices[triangles]
    ahead, back = np.roll(corners, -1, axis=1) - corners, np.roll(corners, 1, axis=1) - corners
    flat_normals = np.cross(ahead[:, 0], back[:, 0])
    flat_normals /= np.maximum(np.linalg.norm(flat_normals, axis=1, keepdims=True), floor)
    lengths = np.linalg.norm(ahead, axis=2) * np.linalg.norm(back, axis=2)
    cosine = np.einsum("tkc,tkc->tk", ahead, back) / np.maximum(lengths, floor)
    angles = np.arccos(np.clip(cosine, -1, 1))
    normals = np.zeros_like(vertices)
    for k in range(3):
        np.add.at(normals, triangles[:, k], angles[:, k, None] * flat_normals)
    length = np.linalg.norm(normals, axis=1, keepdims=True)
    return np.where(length > floor, normals / np.maximum(length, floor), (0, 0, 1)).astype(np.float32)
