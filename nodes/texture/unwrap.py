"""A photo unwrapped onto the model's texture."""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node, warn
from graphface.nodes.face_coordinates import interpolated, mesh_uv
from graphface.nodes.rasterize import rasterized
from graphface.nodes.texture.texels import sampled, texels
from graphface.nodes.types import Camera, FloatArray, Image, Mesh, Surface, Texture
from graphface.nodes.vertex_visibility import vertex_visibility


@node("texture.unwrap")
def unwrap(photo: Image, mesh: Mesh, surface: Surface, *, size: Annotated[int, Field(ge=8, le=8192)] = 512) -> Texture:
    """The photo's face in texture space: every texel has the color that the photo shows at its point of the face.

    Args:
        surface: the mesh drawn into the photo; what it does not show is not seen.
        size: of the texture's sides, in texels.

    Raises:
        UsageError: the mesh has no texture coordinates.
    """
    chart, flat = _chart(mesh, size)
    places = interpolated(_pixels(mesh), chart, flat)
    visible = interpolated(vertex_visibility(surface, mesh)[:, None], chart, flat)[..., 0]
    inside = (
        (places >= -0.5).all(axis=2) & (places[..., 0] <= photo.width - 0.5) & (places[..., 1] <= photo.height - 0.5)
    )
    seen = visible * inside * (chart.triangle >= 0)
    if not (seen > 0).any():
        warn("texture.unwrap: the photo shows nothing of the face; the texture is empty")
    image = Image(sampled(photo.pixels, places) * (chart.coverage[..., None] > 0), encoding=photo.encoding)
    return Texture(image, seen.astype(np.float32))


def _chart(mesh: Mesh, size: int) -> tuple[Surface, Mesh]:
    """The mesh rasterized in texture space, and that flat mesh: vertices at their texture coordinates."""
    at = texels(mesh_uv(mesh), size)
    flat = np.column_stack([at[:, 0], -at[:, 1], np.zeros(len(at))]).astype(np.float32)
    normals = np.tile(np.array([0, 0, 1], np.float32), (len(at), 1))
    laid = replace(mesh, vertices=flat, normals=normals, camera=Camera())
    return rasterized(laid, (size, size), smoothing=0), laid


def _pixels(mesh: Mesh) -> FloatArray:
    return np.asarray(mesh.camera.project(mesh.vertices.astype(np.float64)), np.float32)
