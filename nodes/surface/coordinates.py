"""Face coordinates of every pixel."""

from __future__ import annotations

from graphface import node
from graphface.nodes.face_coordinates import face_coordinates
from graphface.nodes.types import FaceCoordinates, Mesh, Surface


@node("surface.coordinates")
def coordinates(surface: Surface, mesh: Mesh) -> FaceCoordinates:
    """Face coordinates of every pixel: float32 H x W x 2 in [0, 1], -1 where there is no face.

    Raises:
        UsageError: the mesh has no texture coordinates.
    """
    return face_coordinates(surface, mesh)
