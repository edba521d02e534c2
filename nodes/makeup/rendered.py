"""The painted face before its details."""

from __future__ import annotations

import numpy as np

from graphface import node
from graphface.nodes.rendering import rendering
from graphface.nodes.types import Albedo, Image, Shading


@node("makeup.rendered")
def rendered(photo: Image, albedo: Albedo, shading: Shading) -> Image:
    """render(rho, F, theta): the painted face before its details, in the photo's encoding and file format."""
    return photo.with_pixels(np.clip(rendering(albedo, shading), 0, 1))
