"""The mesh over the photo."""

from __future__ import annotations

from typing import Annotated

import cv2
import numpy as np
from pydantic import Field

from graphface import node
from graphface.nodes.types import Image, Mesh

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
