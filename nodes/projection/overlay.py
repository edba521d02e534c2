"""Drawings over a photo, for looking at a fit: mesh, normals, depth, and a checkerboard that moves with the face."""

from __future__ import annotations

from typing import Annotated

import cv2
import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from graphface import node
from graphface.nodes.projection.coordinates import coordinates
from graphface.nodes.types import Image, Mesh, Surface, _picture_depth, _picture_normals

Strength = Annotated[float, Field(ge=0, le=1)]

_LINE = (0.31, 0.86, 0.63)


@node("overlay.mesh")
def mesh(photo: Image, mesh: Mesh, *, strength: Strength = 0.8) -> Image:
    """The triangles that face the camera drawn on the photo."""
    points = mesh.camera.project(mesh.vertices.astype(np.float64))[mesh.triangles]
    a, b = points[:, 1] - points[:, 0], points[:, 2] - points[:, 0]
    front = (a[:, 1] * b[:, 0] - a[:, 0] * b[:, 1] > 0) & np.isfinite(points).all(axis=(1, 2))
    near = np.clip(points[front], -(2.0**14), 2.0**14)  # OpenCV's fixed-point coordinates end at 2^15
    thickness = max(1, round(max(photo.width, photo.height) / 1200))
    # Antialiased lines exist for bytes only, so a mask is drawn and blended.
    mask = np.zeros((photo.height, photo.width), np.uint8)
    cv2.polylines(mask, list(np.round(near * 16).astype(np.int32)), True, 255, thickness, cv2.LINE_AA, shift=4)
    cover = mask[..., None] / np.float32(255) * np.float32(strength)
    drawn = photo.pixels * (1 - cover) + np.array(_LINE, np.float32) * cover
    return photo.with_pixels(drawn.astype(np.float32))


@node("overlay.normals")
def normals(photo: Image, surface: Surface, *, strength: Strength = 0.7) -> Image:
    """The normals as colours over the photo."""
    return _over(photo, _picture_normals(surface.normals), surface, strength)


@node("overlay.depth")
def depth(photo: Image, surface: Surface, *, strength: Strength = 0.7) -> Image:
    """The depth as grey over the photo, near is white."""
    return _over(photo, _picture_depth(surface.depth), surface, strength)


@node("overlay.checkerboard")
def checkerboard(
    photo: Image,
    mesh: Mesh,
    surface: Surface,
    *,
    cells: Annotated[int, Field(ge=2, le=256)] = 16,
    strength: Strength = 0.35,
) -> Image:
    """A checkerboard in face coordinates: in two photos, the same square covers the same part of the face.

    Raises:
        UsageError: the mesh has no texture coordinates.
    """
    at = coordinates(surface, mesh)
    square = np.floor(at * cells)
    odd = square.sum(axis=2) % 2
    # Hue tells the squares apart, so that the eye can find the same one in both pictures.
    colors = np.stack([square[..., 0] / cells, square[..., 1] / cells, 1 - square[..., 0] / cells], axis=2)
    drawn = np.clip(np.where(odd[..., None] > 0, colors, colors * 0.35), 0, 1)
    return _over(photo, np.rint(drawn * 255).astype(np.uint8), surface, strength)


def _over(photo: Image, drawn: NDArray[np.uint8], surface: Surface, strength: float) -> Image:
    cover = (surface.coverage * np.float32(strength))[..., None]
    return photo.with_pixels(photo.pixels * (1 - cover) + drawn.astype(np.float32) / 255 * cover)
