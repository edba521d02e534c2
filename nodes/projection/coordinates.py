"""Per-pixel face coordinates, and which vertices the camera sees.

Face coordinates are the model's texture coordinates: the same numbers are the same point on any face, in any pose and
expression, so two pictures correspond where their coordinates agree (paper, "Face geometry").
"""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import ArrayType, UsageError, node
from graphface.nodes.projection.carried import carried
from graphface.nodes.types import FloatArray, Mesh, Surface

FaceCoordinates = Annotated[
    FloatArray, ArrayType("FaceCoordinates", "H W 2", low=0, high=1, doc="Point on the face (u, v); v up; -1 off it.")
]
Visibility = Annotated[FloatArray, ArrayType("Visibility", "V", low=0, high=1, doc="How far each vertex is seen.")]


@node("surface.coordinates")
def coordinates(surface: Surface, mesh: Mesh) -> FaceCoordinates:
    """The point of the face at every pixel: float32 H x W x 2 in [0, 1], -1 where there is no face.

    Raises:
        UsageError: the mesh has no texture coordinates.
    """
    found = carried(mesh_uv(mesh), surface, mesh)
    return np.where(surface.coverage[..., None] > 0, found, np.float32(-1))


@node("surface.visibility")
def visibility(
    surface: Surface,
    mesh: Mesh,
    *,
    facing: Annotated[float, Field(gt=0, lt=1)] = 0.2,
    depth_tolerance: Annotated[float, Field(gt=0, le=1)] = 0.05,
) -> Visibility:
    """How far the camera sees each vertex: inside the frame, turned towards the viewer, nothing in front of it.

    Args:
        surface: of the same mesh.
        facing: cosine between normal and view from which a vertex is fully seen; turned away, it is not.
        depth_tolerance: how far behind the drawn surface a vertex may lie, in eye distances; at twice it is hidden.

    Returns:
        float32 (V,), 0 hidden to 1 seen.
    """
    height, width = surface.coverage.shape
    pixels = mesh.camera.project(mesh.vertices.astype(np.float64))
    inside = ((pixels >= -0.5) & (pixels <= np.array([width, height]) - 0.5)).all(axis=1)
    x, y = (np.clip(np.rint(pixels[:, k]), 0, n - 1).astype(int) for k, n in ((0, width), (1, height)))
    drawn = surface.coverage[y, x] > 0
    behind = np.where(drawn, surface.depth[y, x] - mesh.vertices[:, 2], 0)
    unhidden = np.clip(2 - behind / max(depth_tolerance * mesh.interocular, 1e-6), 0, 1)
    turned = np.clip(facing_camera(mesh) / facing, 0, 1)
    shown: FloatArray = (inside * unhidden * turned).astype(np.float32)
    return shown


def facing_camera(mesh: Mesh) -> FloatArray:
    """Cosine between each vertex's normal and the direction to the camera: float32 (V,)."""
    nearness = mesh.camera.nearness
    # The camera stands at (0, 0, 1 / nearness); scaled by nearness, infinitely far away is no special case.
    towards = np.array([0, 0, 1]) - nearness * mesh.vertices.astype(np.float64)
    towards /= np.maximum(np.linalg.norm(towards, axis=1, keepdims=True), 1e-9)
    return np.asarray(np.einsum("vc,vc->v", mesh.normals, towards), np.float32)


def mesh_uv(mesh: Mesh) -> FloatArray:
    """The mesh's texture coordinates (V, 2).

    Raises:
        UsageError: it has none.
    """
    if mesh.uv is None:
        raise UsageError("this mesh has no texture coordinates; use geometry.morphable with a model that has them")
    return mesh.uv
