"""A light rotated around the face."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from graphface.nodes.sh.fit import dominant_direction
from graphface.nodes.sh.rotate import rotate
from graphface.nodes.types import Lighting


class TestRotate:
    @settings(max_examples=40, deadline=None)
    @given(st.floats(-180, 180), st.floats(-90, 90), st.floats(-180, 180), st.integers(0, 3))
    def test_keeps_the_power_of_each_order(self, azimuth, elevation, roll, order):
        """Turning a light mixes coefficients within an order and never changes their sum of squares."""
        light = Lighting(np.linspace(-1, 2, (order + 1) ** 2).astype(np.float32))
        turned = rotate(light, azimuth=azimuth, elevation=elevation, roll=roll).coefficients
        for one in range(order + 1):
            part = slice(one * one, (one + 1) ** 2)
            before, after = (float(np.square(c[part]).sum()) for c in (light.coefficients, turned))
            assert after == pytest.approx(before, rel=1e-4, abs=1e-5)

    def test_signs_of_the_angles(self):
        """Azimuth turns the viewer's light to the picture's right, elevation upwards."""
        frontal = Lighting(np.float32([1, 0, 1, 0]))
        np.testing.assert_allclose(dominant_direction(rotate(frontal, azimuth=90)), [1, 0, 0], atol=1e-6)
        np.testing.assert_allclose(dominant_direction(rotate(frontal, elevation=90)), [0, 1, 0], atol=1e-6)
        np.testing.assert_allclose(
            dominant_direction(rotate(Lighting(np.float32([1, 0, 0, 1])), roll=90)), [0, 1, 0], atol=1e-6
        )
