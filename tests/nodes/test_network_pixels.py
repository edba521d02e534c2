"""Pixels as networks expect them."""

from __future__ import annotations

import numpy as np

from graphface.nodes.color import encode_srgb
from graphface.nodes.network_pixels import network_pixels


class TestNetworkPixels:
    def test_finite_and_in_range(self):
        """NaN is 0, values beyond [0, 1] are clipped."""
        found = network_pixels(np.float32([np.nan, -1, 0.5, 2, np.inf, -np.inf]), "srgb")
        assert found.tolist() == [0, 0, 0.5, 1, 1, 0]

    def test_linear_light_is_encoded(self):
        """Linear light becomes sRGB."""
        linear = np.float32([0, 0.2, 1])
        np.testing.assert_allclose(network_pixels(linear, "linear"), encode_srgb(linear), atol=1e-6)
