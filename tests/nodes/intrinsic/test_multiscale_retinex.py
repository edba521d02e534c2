"""Shading is a blur."""

from __future__ import annotations

import numpy as np

from graphface.nodes.intrinsic.multiscale_retinex import multiscale_retinex
from graphface.nodes.types import (
    Image,
)


class TestMultiscaleRetinex:
    def test_a_flat_photo_has_flat_shading(self):
        """At its own intensity, with its color as albedo."""
        parts = multiscale_retinex(Image(np.full((20, 30, 3), (0.6, 0.4, 0.2), np.float32)))
        np.testing.assert_allclose(parts.shading, 0.4, rtol=1e-4)
        np.testing.assert_allclose(parts.albedo, np.broadcast_to([1.5, 1, 0.5], (20, 30, 3)), rtol=1e-4)

    def test_shading_is_smooth(self, rng):
        """Noise stays in the albedo."""
        photo = Image(rng.uniform(0.3, 0.7, (64, 64, 3)).astype(np.float32))
        shading = multiscale_retinex(photo).shading
        assert np.abs(np.diff(shading, axis=0)).max() < 0.2 * np.abs(np.diff(photo.pixels.mean(axis=2), axis=0)).max()
