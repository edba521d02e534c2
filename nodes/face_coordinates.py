"""Face coordinates of pixels.

Face coordinates are the model's texture coordinates. Equal coordinates are the same point on any face, in any pose and
expression, so two pictures correspond where their coordinates agree (paper, "Face geometry").
"""

from __future__ import annotations

import numpy as np

from graphface import UsageError
from graphface.nodes.types import FaceCoordinates, FloatArray, Mesh, Surface


def interpolated(of_vertex: FloatArray, surface: Surface, mesh: Mesh) -> FloatArray:
    """Vertex values (V, C), interpolated at every pixel: float32 H x W x C, 0 off the mesh."""
    values = np.zeros((*surface.triangle.shape, of_vertex.shape[1]), np.float32)
    covered = surface.triangle >= 0
    corners = mesh.triangles[surface.triangle[covered]]
    weights = surface.barycentric[covered]
    values[covered] = np.einsum("pk,pkc->pc", weights, of_vertex.astype(np.float32)[corners])
    return values


def face_coordinates(surface: Surface, mesh: Mesh) -> FaceCoordinates:
    """The mesh's texture coordinates at every pixel: float32 H x W x 2 in [0, 1], -1 where there is no face.

    Raises:
        UsageError: the mesh has no texture coordinates.
    """
    found = interpolated(mesh_uv(mesh), surface, mesh)
    return np.where(surface.coverage[..., None] > 0, found, np.float32(-1))


def mesh_uv(mesh: Mesh) -> FloatArray:
    """The mesh's texture coordinates (V, 2).

    Raises:
        UsageError: it has none.
    """
    if mesh.uv is None:
        raise UsageError("this mesh has no texture coordinates; use geometry.morphable with a model that has them")
    return mesh.uv
