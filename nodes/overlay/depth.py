"""The depth over the photo."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from graphface import node
from graphface.nodes.overlay.layer import laid_over
from graphface.nodes.pictures.maps import depth_bytes
from graphface.nodes.types import Image, Surface

Strength = Annotated[float, Field(ge=0, le=1)]


@node("overlay.depth")
def depth(photo: Image, surface: Surface, *, strength: Strength = 0.7) -> Image:
    """The depth as grey over the photo, near is white."""
    return laid_over(photo, depth_bytes(surface.depth), surface, strength)
