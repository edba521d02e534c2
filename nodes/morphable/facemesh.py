"""The face's geometry straight from the landmark network's own depth."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import UsageError, node
from graphface.nodes.morphable.normals import vertex_normals
from graphface.nodes.morphable.topology import cylinder, facemesh_topology
from graphface.nodes.types import Camera, Landmarks, Mesh


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
    topology = facemesh_topology()
    return Mesh(
        vertices=vertices.astype(np.float32),
        triangles=topology.triangles,
        normals=vertex_normals(vertices, topology.triangles),
        camera=Camera(center=(float(center[0]), float(center[1]))),
        interocular=landmarks.interocular,
        uv=cylinder(topology.mean).astype(np.float32),
        mirror=topology.mirror,
        facemesh=np.arange(len(vertices), dtype=np.int32),
    )
