"""Lights as values."""

from __future__ import annotations

import numpy as np
import pytest

from graphface.nodes.color import encode_srgb
from graphface.nodes.types import (
    Environment,
    Lighting,
)


class TestLighting:
    @pytest.mark.parametrize(("count", "order"), [(1, 0), (4, 1), (9, 2), (16, 3)])
    def test_order(self, count, order):
        """By the number of coefficients, in one channel or three."""
        assert Lighting(np.zeros(count, np.float32)).order == order
        assert Lighting(np.zeros((count, 3), np.float32)).order == order


class TestEnvironment:
    def test_picture_of_a_bright_panorama(self):
        """Its mean is shown at a quarter of white, linear; a dim one is shown as it is."""
        for radiance, shown in ((100.0, 0.25), (0.1, 0.1)):
            picture = Environment.picture(Environment(np.full((2, 4, 3), radiance, np.float32)))
            expected = encode_srgb(np.float32([shown]))[0] * 255
            np.testing.assert_allclose(picture, expected, atol=0.51)
