"""Blur: a Gaussian, whether it is made on the picture or on a smaller copy."""

from __future__ import annotations

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from graphface.nodes.blur import blurred, gaussian


class TestBlurred:
    @pytest.mark.parametrize("sigma", [1.0, 4.0, 5.5, 9.0, 30.0])
    @pytest.mark.parametrize("channels", [(), (3,)])
    def test_is_a_gaussian(self, sigma, channels, rng):
        """Away from the border it is the full-size blur to 1 % of the contrast."""
        values = (rng.random((300, 260, *channels)) > 0.5).astype(np.float32)
        values[:, :130] *= 0.2
        exact = cv2.GaussianBlur(values, (0, 0), sigma, borderType=cv2.BORDER_REPLICATE)
        inner = np.s_[round(2 * sigma) : -round(2 * sigma)]
        np.testing.assert_allclose(blurred(values, sigma)[inner, inner], exact[inner, inner], atol=0.01)

    @given(st.integers(1, 40), st.integers(1, 40), st.floats(0.3, 1e4), st.floats(-1e3, 1e3, width=32))
    def test_a_constant_stays(self, height, width, sigma, value):
        """Whatever the picture's size and the blur's."""
        out = blurred(np.full((height, width), value, np.float32), sigma)
        assert out.shape == (height, width)
        np.testing.assert_allclose(out, value, rtol=1e-4, atol=1e-6)


class TestGaussian:
    def test_adds_variances(self, rng):
        """Two blurs in turn are one blur of the root of their summed variances."""
        values = rng.random((60, 60), np.float32)
        twice, once = gaussian(gaussian(values, 3.0), 4.0), gaussian(values, 5.0)
        np.testing.assert_allclose(twice[15:-15, 15:-15], once[15:-15, 15:-15], atol=0.01)

    def test_at_least_half_a_pixel(self, rng):
        """A narrower Gaussian would be a single pixel, and 0 an error."""
        values = rng.random((9, 9, 3), np.float32)
        np.testing.assert_array_equal(gaussian(values, 0.0), gaussian(values, 0.5))
