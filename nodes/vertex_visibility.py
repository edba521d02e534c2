"""Which vertices of a mesh the camera sees."""

from __future__ import annotations

import numpy as np

from graphface.nodes.types import FloatArray, Mesh, Surface, Visibility


def vertex_visibility(
    surface: Surface, mesh: Mesh, *, facing: float = 0.2, depth_tolerance: float = 0.05
) -> Visibility:
    """How far the camera sees each vertex, float32 (V,), 0 to 1; see `surface.visibility`."""
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
