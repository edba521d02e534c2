"""Visibility of the vertices of a mesh."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.types import FloatArray, Mesh, Surface, Visibility


def vertex_visibility(
    surface: Surface, mesh: Mesh, *, facing: float = 0.2, depth_tolerance: float = 0.05
) -> Visibility:
    """How visible each vertex is, float32 (V,), 0 to 1; see `surface.visibility`."""
    towards_camera = np.clip(facing_camera(mesh) / facing, 0, 1)
    return np.asarray(unoccluded(surface, mesh, depth_tolerance) * towards_camera, np.float32)


def unoccluded(surface: Surface, mesh: Mesh, depth_tolerance: float) -> FloatArray:
    """1 for the vertices inside the frame that no other surface occludes: float32 (V,).

    Args:
        surface: the mesh drawn into the picture.
        depth_tolerance: depth behind the drawn surface up to which a vertex is visible, in inter-ocular distances; at
            twice that the value is 0.
    """
    row, column, inside = vertex_pixels(mesh, surface.coverage.shape)
    drawn = surface.coverage[row, column] > 0
    behind = np.where(drawn, surface.depth[row, column] - mesh.vertices[:, 2], 0)
    return np.asarray(inside * np.clip(2 - behind / max(depth_tolerance * mesh.interocular, 1e-6), 0, 1), np.float32)


def vertex_pixels(mesh: Mesh, shape: tuple[int, ...]) -> tuple[NDArray[np.intp], NDArray[np.intp], NDArray[np.bool_]]:
    """Row and column of the picture's pixel nearest to each vertex, and whether the vertex lies inside the frame.

    Three arrays (V,); `shape` is the picture's (height, width).
    """
    height, width = shape
    pixels = mesh.camera.project(mesh.vertices.astype(np.float64))
    inside = np.asarray(((pixels >= -0.5) & (pixels <= np.array([width, height]) - 0.5)).all(axis=1), np.bool_)
    column, row = (np.clip(np.rint(pixels[:, k]), 0, n - 1).astype(np.intp) for k, n in ((0, width), (1, height)))
    return row, column, inside


def facing_camera(mesh: Mesh) -> FloatArray:
    """Cosine between each vertex's normal and the direction to the camera: float32 (V,)."""
    nearness = mesh.camera.nearness
    # The camera is at (0, 0, 1 / nearness); times nearness, infinite distance is no special case.
    towards = np.array([0, 0, 1]) - nearness * mesh.vertices.astype(np.float64)
    towards /= np.maximum(np.linalg.norm(towards, axis=1, keepdims=True), 1e-9)
    return np.asarray(np.einsum("vc,vc->v", mesh.normals, towards), np.float32)
