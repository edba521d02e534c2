"""Spherical harmonics as panoramas."""

from __future__ import annotations

import numpy as np
import pytest

from graphface import GraphfaceWarning
from graphface.nodes.sh.from_environment import from_environment
from graphface.nodes.sh.to_environment import to_environment
from graphface.nodes.types import Lighting


class TestToEnvironment:
    def test_there_and_back(self):
        """A light's smoothest panorama gives the light again."""
        light = Lighting(np.float32([2.5, 0.3, 0.4, -0.3, 0.05, 0.02, 0.04, 0.03, -0.05]))
        again = from_environment(to_environment(light, height=128, quantity="radiance"))
        np.testing.assert_allclose(again.coefficients[:, 1], light.coefficients, atol=2e-3)

    @pytest.mark.parametrize("quantity", ["irradiance", "radiance"])
    def test_is_never_negative(self, quantity):
        """Where a truncated series is negative the panorama is dark."""
        radiance = to_environment(Lighting(np.float32([0.1, 0, 1, 0])), quantity=quantity).radiance
        assert radiance.shape == (64, 128, 3)
        assert radiance.min() == 0
        assert radiance.max() > 0

    def test_order_three_has_no_radiance(self):
        """It is left out, with a warning."""
        light = Lighting(np.ones(16, np.float32))
        with pytest.warns(GraphfaceWarning, match="order 3"):
            found = to_environment(light, quantity="radiance")
        np.testing.assert_array_equal(
            found.radiance, to_environment(Lighting(light.coefficients[:9]), quantity="radiance").radiance
        )
