"""The color of a black body."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from graphface.nodes.temperature import kelvin_color


class TestKelvinColor:
    def test_6500_is_white(self):
        """The neutral temperature changes no color."""
        np.testing.assert_allclose(kelvin_color(6500), 1, rtol=1e-6)

    @given(st.floats(1667, 24999))
    def test_warmer_is_redder(self, kelvin):
        """Red over blue falls with temperature; luminance stays 1, nothing is negative."""
        red, green, blue = kelvin_color(kelvin)
        hotter = kelvin_color(kelvin + 1)
        assert min(red, green, blue) >= 0
        assert 0.2126 * red + 0.7152 * green + 0.0722 * blue == pytest.approx(1, rel=1e-5)
        assert red * hotter[2] >= hotter[0] * blue * (1 - 1e-3)

    def test_out_of_range_is_clamped(self):
        """Colder than 1667 K and hotter than 25000 K look like these."""
        assert kelvin_color(0) == kelvin_color(1667)
        assert kelvin_color(1e9) == kelvin_color(25000)
