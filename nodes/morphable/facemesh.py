"""The face's geometry straight from the landmark network's own depth."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from graphface import UsageError, node
from graphface.nodes.morphable.topology import facemesh_topology
from graphface.nodes.types import Camera, FloatArray, Landmarks, Mesh


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
    if landmarks.scheme != "facemesh468":
        raise UsageError(
            f"geometry.facemesh needs landmarks of the scheme 'facemesh468', got {landmarks.scheme!r}; "
            "use landmarks.facemesh, or a geometry that fits a model to those points"
        )
    points = landmarks.points.astype(np.float64)
    center = points.mean(axis=0)
    vertices = (points - center) * (1, -1, depth)
    triangles = facemesh_topology().triangles
    return Mesh(
        vertices=vertices.astype(np.float32),
        triangles=triangles,
        normals=vertex_normals(vertices, triangles),
        camera=Camera(center=(float(center[0]), float(center[1]))),
        interocular=landmarks.interocular,
    )


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
