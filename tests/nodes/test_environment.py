"""Panoramas: where their pixels look to, and the light that they give."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from graphface.nodes.environment import directions, environment_light, solid_angles
from graphface.nodes.harmonics import ambient, basis
from graphface.nodes.types import Environment


class TestPixels:
    @settings(max_examples=20, deadline=None)
    @given(st.integers(1, 40), st.integers(1, 40))
    def test_pixels_tile_the_sphere(self, height, width):
        """Solid angles sum to 4 pi, directions are unit vectors, whatever the size."""
        assert solid_angles(height, width).sum() == pytest.approx(4 * np.pi)
        np.testing.assert_allclose(np.linalg.norm(directions(height, width), axis=2), 1, atol=1e-12)

    def test_up_is_the_first_row(self):
        """Rows run from straight up to straight down."""
        rows = directions(64, 128)[:, 0, 1]
        assert rows[0] > 0.99
        assert rows[-1] < -0.99
        assert (np.diff(rows) < 0).all()


class TestEnvironmentLight:
    @pytest.mark.parametrize("order", [0, 1, 2, 3])
    def test_even_radiance_is_ambient(self, order):
        """Radiance 1 from everywhere is irradiance 1 for every normal."""
        light = environment_light(Environment(np.ones((64, 128, 3), np.float32)), order)
        np.testing.assert_allclose(light.coefficients, ambient(np.ones(3, np.float32), order).coefficients, atol=1e-3)

    def test_irradiance_of_a_distant_light(self):
        """A small bright patch gives about Lambert's cosine, within the few percent of the second order."""
        radiance = np.zeros((64, 128, 3), np.float32)
        radiance[31:33, 63:65] = 1 / solid_angles(64, 128)[31:33, 63:65, None].sum()
        light = environment_light(Environment(radiance * np.float32(np.pi)))
        normals = np.float32([[0, 0, 1], [0.6, 0, 0.8], [1, 0, 0], [0, 0, -1]])
        np.testing.assert_allclose((basis(normals, 2) @ light.coefficients)[:, 0], [1, 0.8, 0, 0], atol=0.1)
