"""Alpha blending."""

from __future__ import annotations

from graphface import node
from graphface.nodes.types import Image, Landmarks, Mask


@node("blend.linear")
def linear(base: Image, layer: Image, mask: Mask, landmarks: Landmarks) -> Image:
    """base + mask * (layer - base). Where the mask is 0 the base does not change by a bit."""
    return base.with_pixels(base.pixels + mask[..., None] * (layer.pixels - base.pixels))
