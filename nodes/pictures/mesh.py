"""Meshes as shaded views from three sides."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import cv2
import numpy as np

from graphface.nodes.color import encode_srgb
from graphface.nodes.face_coordinates import interpolated
from graphface.nodes.harmonics import rotation_matrix
from graphface.nodes.morphable.model import MorphableModel
from graphface.nodes.morphable.normals import vertex_normals
from graphface.nodes.pictures.photo import Pixels
from graphface.nodes.rasterize import rasterized
from graphface.nodes.types import Camera, FloatArray, Mesh, TexturedMesh
from graphface.pictures.card import draw_text
from graphface.pictures.colors import as_bytes
from graphface.pictures.text import PAPER
from graphface.values.picture import Picture, View

_ANGLES = (0.0, 45.0, 90.0)
_WIDTH = 900
"""Pixels of the three views together, where the view does not say."""
_FINER = 2
"""Drawn this much larger and then reduced, so that edges are smooth."""
_LIGHT = np.array([-0.4, 0.5, 0.77], np.float32)
_NOTE = "as the camera sees it, and turned by 45 and 90 degrees"

DrawnMesh = Callable[[Mesh, tuple[int, int]], Pixels]
"""From a mesh whose camera is set, and height and width, to a picture of it."""


def draw_mesh(mesh: Mesh, view: View) -> Picture:
    """The mesh in grey under a light from the upper left."""
    note = f"{len(mesh.vertices)} vertices, {len(mesh.triangles)} triangles; {_NOTE}"
    return _three_views(mesh, view, _clay, note)


def draw_textured(textured: TexturedMesh, view: View) -> Picture:
    """The mesh in its own colors, without a light."""
    if textured.mesh.uv is None:
        return draw_mesh(textured.mesh, view)
    texture = textured.texture.image
    pixels = encode_srgb(texture.pixels) if texture.encoding == "linear" else texture.pixels

    def in_color(mesh: Mesh, size: tuple[int, int]) -> Pixels:
        assert mesh.uv is not None
        surface = rasterized(mesh, size)
        uv = interpolated(mesh.uv, surface, mesh)
        x, y = uv[..., 0] * texture.width - 0.5, (1 - uv[..., 1]) * texture.height - 0.5
        found = cv2.remap(np.ascontiguousarray(pixels), x, y, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)
        return np.where(surface.coverage[..., None] > 0, as_bytes(np.asarray(found)), np.array(PAPER, np.uint8))

    return _three_views(textured.mesh, view, in_color, f"the texture on the mesh; {_NOTE}")


def draw_model(model: MorphableModel, view: View) -> Picture:
    """The mean face of a model."""
    mean = model.mean.astype(np.float64)
    normals = vertex_normals(mean, model.triangles).astype(np.float32)
    mesh = Mesh(model.mean, model.triangles, normals, Camera(), 1.0)
    note = f"{model.name}: the mean; {len(model.identity)} identities, {len(model.expression)} expressions; {_NOTE}"
    return _three_views(mesh, view, _clay, note)


def _three_views(mesh: Mesh, view: View, drawn: DrawnMesh, note: str) -> Picture:
    finite = np.isfinite(mesh.vertices).all(axis=1)
    if not len(mesh.triangles) or not finite.all() or np.ptp(mesh.vertices, axis=0).max() < 1e-9:
        odd = f", {int((~finite).sum())} not finite" if not finite.all() else ""
        return draw_text(f"a mesh that cannot be drawn: {len(mesh.vertices)} vertices{odd}", view)
    side = max(24, (view.size or _WIDTH) // len(_ANGLES))
    middle = (mesh.vertices.min(axis=0) + mesh.vertices.max(axis=0)) / 2
    reach = float(np.linalg.norm(mesh.vertices - middle, axis=1).max()) * 2.05
    height = min(2 * side, max(side // 3, int(side * float(np.ptp(mesh.vertices[:, 1])) * 1.1 / reach)))
    size = (_FINER * height, _FINER * side)
    views = [drawn(_turned(mesh, middle, _FINER * side / reach, size, angle), size) for angle in _ANGLES]
    pixels = cv2.resize(np.concatenate(views, axis=1), (side * len(views), height), interpolation=cv2.INTER_AREA)
    return Picture(np.asarray(pixels), note)


def _turned(mesh: Mesh, middle: FloatArray, scale: float, size: tuple[int, int], angle: float) -> Mesh:
    """The mesh turned about its vertical axis, in the middle of a picture in parallel projection."""
    turn = rotation_matrix(angle, 0).T.astype(np.float32)
    camera = Camera(scale, ((size[1] - 1) / 2, (size[0] - 1) / 2))
    vertices = ((mesh.vertices - middle) @ turn).astype(np.float32)
    return replace(mesh, vertices=vertices, normals=mesh.normals @ turn, camera=camera, interocular=0.0)


def _clay(mesh: Mesh, size: tuple[int, int]) -> Pixels:
    """Grey under a light, over paper. Both sides of a surface are drawn, what faces away from the light is dark."""
    height, width = size
    radius = max(height, width) / mesh.camera.scale
    distance = 40 * radius  # so far away that perspective does not show
    placed = mesh.vertices - np.array([0, 0, distance], np.float32)
    shade = 0.22 + 0.7 * np.clip(mesh.normals @ _LIGHT, 0, 1)
    colors = np.repeat(shade.astype(np.float32)[:, None], 3, axis=1)
    drawn = np.full((height, width, 3), np.array(PAPER, np.float32) / 255, np.float32)
    depth = np.full((height, width), distance + 2 * radius, np.float32)
    settings = cv2.TriangleRasterizeSettings()
    settings.setShadingType(cv2.RASTERIZE_SHADING_SHADED)
    settings.setCullingMode(cv2.RASTERIZE_CULLING_NONE)
    opening = 2 * float(np.arctan(height / 2 / mesh.camera.scale / distance))
    near, far = distance - 2 * radius, distance + 2 * radius
    triangles = np.ascontiguousarray(mesh.triangles, np.int32)
    pose = np.eye(4, dtype=np.float32)
    cv2.triangleRasterize(placed, triangles, colors, drawn, depth, pose, opening, near, far, settings)
    return as_bytes(drawn)
