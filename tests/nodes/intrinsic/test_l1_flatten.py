"""Edges that remain after flattening are reflectance."""

from __future__ import annotations

import numpy as np

from graphface.nodes.intrinsic.l1_flatten import l1_flatten
from graphface.nodes.types import (
    Image,
)


class TestL1Flatten:
    def test_a_change_of_hue_is_reflectance(self):
        """Two flat colors under one light: the shading has no edge."""
        pixels = np.empty((32, 64, 3), np.float32)
        pixels[:, :32], pixels[:, 32:] = (0.6, 0.3, 0.2), (0.2, 0.4, 0.5)
        shading = l1_flatten(Image(pixels)).shading
        np.testing.assert_allclose(shading, shading.mean(), rtol=0.02)

    def test_a_ramp_of_brightness_is_shading(self):
        """One color under a gradient of light: the albedo is flat."""
        ramp = np.linspace(0.4, 0.8, 64, dtype=np.float32)[None, :, None] * np.float32([1, 0.7, 0.5])
        albedo = l1_flatten(Image(np.repeat(ramp, 32, axis=0))).albedo
        np.testing.assert_allclose(albedo / albedo.mean(axis=(0, 1)), 1, atol=0.1)
