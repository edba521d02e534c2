"""A checkerboard that moves with the face."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node
from graphface.nodes.face_coordinates import face_coordinates
from graphface.nodes.overlay.layer import laid_over
from graphface.nodes.types import Image, Mesh, Surface

Strength = Annotated[float, Field(ge=0, le=1)]


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
    at = face_coordinates(surface, mesh)
    square = np.floor(at * cells)
    odd = square.sum(axis=2) % 2
    # Each square has its own hue, so that the eye can find the same one in both pictures.
    colors = np.stack([square[..., 0] / cells, square[..., 1] / cells, 1 - square[..., 0] / cells], axis=2)
    drawn = np.clip(np.where(odd[..., None] > 0, colors, colors * 0.35), 0, 1)
    return laid_over(photo, np.rint(drawn * 255).astype(np.uint8), surface, strength)
