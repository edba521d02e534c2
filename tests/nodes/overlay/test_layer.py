"""A drawing laid over a photo."""

import numpy as np

from graphface.nodes.overlay.layer import laid_over
from graphface.nodes.types import Image, Surface


def test_as_far_as_the_surface_covers():
    """Half the strength mixes evenly where the surface is, and leaves the photo elsewhere."""
    flat = np.zeros((1, 2, 3), np.float32)
    surface = Surface(flat, flat[..., 0], np.float32([[1, 0]]), np.array([[0, -1]], np.int32), flat)
    photo = Image(np.full((1, 2, 3), 0.2, np.float32))
    mixed = laid_over(photo, np.full((1, 2, 3), 255, np.uint8), surface, strength=0.5)
    np.testing.assert_allclose(mixed.pixels[0, :, 0], [0.6, 0.2], rtol=1e-6)
