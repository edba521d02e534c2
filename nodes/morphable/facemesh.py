"""The 468 points of FaceMesh as a mesh."""

from __future__ import annotations

import numpy as np

from graphface import UsageError
from graphface.nodes.morphable.normals import vertex_normals
from graphface.nodes.morphable.topology import cylinder, facemesh_topology
from graphface.nodes.types import Camera, Landmarks, Mesh


def facemesh_mesh(landmarks: Landmarks, depth: float = 1.0) -> Mesh:
    """The 468 points as a mesh in the camera frame; see `geometry.facemesh`.

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
