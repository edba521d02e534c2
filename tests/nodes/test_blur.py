"""Blur: a Gaussian, whether it is made on the picture or on a smaller copy."""

from __future__ import annotations

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from graphface.nodes.blur import blurred


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
