"""A drawing laid over a photo where the face is."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.types import Image, Surface


def laid_over(photo: Image, drawn: NDArray[np.uint8], surface: Surface, strength: float) -> Image:
    """The drawing, H x W x 3 bytes, over the photo with opacity `strength` (0 to 1) where the surface covers it."""
    cover = (surface.coverage * np.float32(strength))[..., None]
    return photo.with_pixels(photo.pixels * (1 - cover) + drawn.astype(np.float32) / 255 * cover)
