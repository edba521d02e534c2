"""Into the logarithmic domain and back."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from graphface import GraphfaceWarning
from graphface.nodes.intrinsic.log_domain import DARKEST, finite_pixels, intrinsic_images, log_intensity
from graphface.nodes.types import (
    Image,
)


class TestFinitePixels:
    def test_holes_are_filled_with_a_warning(self):
        """By the mean of the rest; a finite photo is the same array."""
        pixels = np.full((2, 2, 3), 0.25, np.float32)
        assert finite_pixels(Image(pixels), "intrinsic.test") is pixels
        holes = pixels.copy()
        holes[0, 0, 1] = np.nan
        with pytest.warns(GraphfaceWarning, match=r"intrinsic\.test: 1 pixels"):
            np.testing.assert_array_equal(finite_pixels(Image(holes), "intrinsic.test"), pixels)


class TestLogIntensity:
    def test_stops_falling_in_the_dark(self):
        """Black is as dark as the darkest that counts."""
        found = log_intensity(np.float32([[[0, 0, 0], [1, 1, 1]]]))
        np.testing.assert_allclose(found, [[np.log(DARKEST), 0]], atol=1e-6)


class TestIntrinsicImages:
    @given(st.floats(-1e3, 1e3))
    def test_the_constant_does_not_matter(self, constant):
        """Log shading is given up to a constant; shading gets the mean of the intensity."""
        rng = np.random.default_rng(0)
        pixels, log_shading = rng.uniform(0.2, 0.9, (6, 7, 3)).astype(np.float32), rng.normal(0, 0.2, (6, 7))
        parts = intrinsic_images(pixels, (log_shading + constant).astype(np.float32), None, 0.05)
        assert parts.shading.mean() == pytest.approx(pixels.mean(), rel=1e-4)
        np.testing.assert_allclose(parts.albedo * parts.shading[..., None], pixels, atol=1e-6)

    def test_over_a_mask(self):
        """Only pixels of the mask decide the scale; an empty mask is none."""
        pixels, flat = np.ones((2, 2, 3), np.float32), np.zeros((2, 2), np.float32)
        pixels[0] = 0.25
        mask = np.float32([[1, 1], [0, 0]])
        assert intrinsic_images(pixels, flat, mask, 0.05).shading[0, 0] == pytest.approx(0.25)
        assert intrinsic_images(pixels, flat, 0 * mask, 0.05).shading[0, 0] == pytest.approx(0.625)
