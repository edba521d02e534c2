"""A picture put together from albedo, shading and detail map."""

import numpy as np
import pytest

from graphface.nodes.blend.recombine import recombine
from graphface.nodes.types import DetailMap, Image


def parts(value: float, offset: float = 0.0):
    """Albedo, shading and detail map of a grey picture with albedo 0.5."""
    ones = np.ones((2, 2, 3), np.float32)
    return ones * np.float32(0.5), np.full((2, 2), 2 * (value - offset), np.float32), DetailMap(ones * offset)


def grey(value: float) -> Image:
    return Image(np.full((2, 2, 3), value, np.float32))


class TestRecombine:
    def test_the_equation(self):
        """rho s + I_d, where that is far from black and white."""
        np.testing.assert_allclose(recombine(grey(0.5), *parts(0.6, 0.1)).pixels, 0.6, rtol=1e-6)

    @pytest.mark.parametrize("value", [0.0, 0.3, 1.0])
    def test_no_change(self, value):
        """The parts of a picture give that picture back, to its very ends."""
        np.testing.assert_allclose(recombine(grey(value), *parts(value)).pixels, value, atol=1e-6)

    @pytest.mark.parametrize("value", [-5.0, 5.0])
    @pytest.mark.parametrize("shoulder", [0.0, 0.5, 1.0])
    def test_stays_in_range(self, value, shoulder):
        """Whatever the light, the picture stays within [0, 1]."""
        pixels = recombine(grey(0.5), *parts(value), shoulder=shoulder).pixels
        assert pixels.min() >= 0
        assert pixels.max() <= 1

    def test_the_shoulder_is_monotonous(self):
        """More light never makes a pixel darker, and with a shoulder different lights stay different."""
        found = [float(recombine(grey(0.5), *parts(v)).pixels[0, 0, 0]) for v in np.linspace(0.5, 1.5, 20)]
        assert np.diff(found).min() > 0
