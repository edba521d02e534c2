"""The normals over the photo."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from graphface import node
from graphface.nodes.overlay.layer import laid_over
from graphface.nodes.pictures.maps import normals_bytes
from graphface.nodes.types import Image, Surface

Strength = Annotated[float, Field(ge=0, le=1)]


@node("overlay.normals")
def normals(photo: Image, surface: Surface, *, strength: Strength = 0.7) -> Image:
    """The normals as colors over the photo."""
    return laid_over(photo, normals_bytes(surface.normals), surface, strength)
