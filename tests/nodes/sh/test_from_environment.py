"""Panoramas projected to spherical harmonics."""

from __future__ import annotations

import numpy as np

from graphface.nodes.harmonics import ambient
from graphface.nodes.sh.fit import dominant_direction
from graphface.nodes.sh.from_environment import from_environment
from graphface.nodes.types import Environment


class TestFromEnvironment:
    def test_even_panorama_is_ambient(self):
        """Radiance 1 from everywhere is shading 1."""
        light = from_environment(Environment(np.ones((32, 64, 3), np.float32)))
        np.testing.assert_allclose(light.coefficients, ambient(np.ones(3, np.float32), 2).coefficients, atol=2e-3)

    def test_a_patch_lights_from_its_side(self):
        """The middle column is before the face; a quarter of the width is to the picture's right."""
        for column, expected in ((32, (0, 0, 1)), (16, (1, 0, 0)), (48, (-1, 0, 0))):
            radiance = np.zeros((32, 64, 3), np.float32)
            radiance[15:17, column - 1 : column + 1] = 100
            found = dominant_direction(from_environment(Environment(radiance)))
            np.testing.assert_allclose(found, expected, atol=0.02)
