"""Values of vertices carried to the pixels that see them."""

from __future__ import annotations

import numpy as np

from graphface.nodes.types import FloatArray, Mesh, Surface


def carried(of_vertex: FloatArray, surface: Surface, mesh: Mesh) -> FloatArray:
    """Vertex values (V, C), interpolated: float32 H x W x C, 0 off the mesh."""
    values = np.zeros((*surface.triangle.shape, of_vertex.shape[1]), np.float32)
    covered = surface.triangle >= 0
    corners = mesh.triangles[surface.triangle[covered]]
    weights = surface.barycentric[covered]
    values[covered] = np.einsum("pk,pkc->pc", weights, of_vertex.astype(np.float32)[corners])
    return values
