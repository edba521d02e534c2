"""The face's geometry from the landmark network's own depth."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from graphface import node
from graphface.nodes.morphable.facemesh import facemesh_mesh
from graphface.nodes.types import Landmarks, Mesh


@node("geometry.facemesh")
def facemesh(landmarks: Landmarks, *, depth: Annotated[float, Field(gt=0, le=4)] = 1.0) -> Mesh:
    """A mesh of the 468 FaceMesh points, seen by a weak-perspective camera.

    Args:
        landmarks: scheme "facemesh468".
        depth: factor on the network's z; below 1 the face gets flatter.

    Returns:
        468 vertices in the camera frame, one unit a pixel, origin at the mean point; the triangles of
        `facemesh_topology`; normals weighted by the triangles' angles.

    Raises:
        UsageError: the landmarks follow another scheme.
    """
    return facemesh_mesh(landmarks, depth)
