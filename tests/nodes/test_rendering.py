"""Albedo, shading and detail map put together."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from graphface.nodes.detail.additive import additive
from graphface.nodes.detail.split import split
from graphface.nodes.intrinsic.intensity import intensity
from graphface.nodes.rendering import applied, recombined, rendering
from graphface.nodes.types import (
    DetailMap,
    FileFormat,
    Image,
)


class TestRecombined:
    def test_keeps_alpha_file_format_and_encoding(self):
        """What is not pixels is handed on."""
        alpha, form = np.full((2, 2), 0.5, np.float32), FileFormat("TIFF", 16, b"icc")
        photo = Image(np.full((2, 2, 3), 0.5, np.float32), alpha, "linear", form)
        albedo, shading = intensity(photo).albedo, np.ones((2, 2), np.float32)
        out = recombined(photo, albedo, shading, additive(photo, albedo, shading))
        assert out.alpha is alpha
        assert (out.encoding, out.file) == ("linear", form)

    @settings(max_examples=60, deadline=None)
    @given(
        st.floats(0, 1, width=32),
        st.floats(-1e6, 1e6, width=32),
        st.floats(-1e6, 1e6, width=32),
        st.sampled_from([0.0, 0.1, 0.5, 1.0]),
    )
    def test_stays_in_range_and_monotone(self, value, one, other, shoulder):
        """Any change leaves the pixel in [0, 1], and more light never gives a darker pixel."""
        low, high = sorted((one, other))
        photo = Image(np.full((1, 1, 3), value, np.float32))
        albedo = np.ones((1, 1, 3), np.float32)
        detail = additive(photo, albedo, np.float32([[value]]))
        results = [
            recombined(photo, albedo, np.float32([[s]]), detail, shoulder=shoulder).pixels.max() for s in (low, high)
        ]
        assert 0 <= results[0] <= results[1] + 1e-6 <= 1 + 2e-6

    def test_values_beyond_white_may_stay(self):
        """An unchanged pixel is never touched, in range or not."""
        pixels = np.float32([[[-0.5, 0.5, 3]]])
        photo, albedo, shading = Image(pixels), np.ones((1, 1, 3), np.float32), np.ones((1, 1), np.float32)
        np.testing.assert_allclose(recombined(photo, albedo, shading, additive(photo, albedo, shading)).pixels, pixels)

    def test_few_and_many_values_beyond_the_knee(self):
        """A picture that overshoots in one pixel bends it like a picture that overshoots everywhere."""
        albedo, shading = np.ones((30, 30, 3), np.float32), np.full((30, 30), 0.5, np.float32)
        photo = Image(np.full((30, 30, 3), 0.5, np.float32))
        everywhere = recombined(photo, albedo, shading + 2, additive(photo, albedo, shading)).pixels
        shading_of_one = shading.copy()
        shading_of_one[3, 4] += 2
        once = recombined(photo, albedo, shading_of_one, additive(photo, albedo, shading)).pixels
        np.testing.assert_allclose(once[3, 4], everywhere[3, 4], rtol=1e-6)
        np.testing.assert_allclose(once[0, 0], 0.5)


class TestApplied:
    def test_each_part(self):
        """photo = min(gain * min(rendering, pivot) + offset, ceiling) + max(rendering - pivot, 0)."""
        part = lambda value: np.full((1, 1, 3), value, np.float32)  # noqa: E731
        assert applied(DetailMap(part(0.1)), part(0.5)) == pytest.approx(0.6)
        assert applied(DetailMap(part(0.1), part(2)), part(0.5)) == pytest.approx(1.1)
        assert applied(DetailMap(part(0.1), part(2), part(0.4)), part(0.5)) == pytest.approx(1.0)
        assert applied(DetailMap(part(0.1), part(2), part(0.4), part(0.7)), part(0.5)) == pytest.approx(0.8)


class TestRendering:
    def test_grey_and_colored_shading(self):
        """A grey shading multiplies all channels; the albedo stays as it was."""
        albedo = np.float32([[[0.2, 0.4, 0.8]]])
        np.testing.assert_allclose(rendering(albedo, np.float32([[0.5]])), [[[0.1, 0.2, 0.4]]])
        np.testing.assert_allclose(rendering(albedo, np.float32([[[1, 0.5, 0]]])), [[[0.2, 0.2, 0]]])
        np.testing.assert_array_equal(albedo, np.float32([[[0.2, 0.4, 0.8]]]))


class TestAddedLight:
    @staticmethod
    def lit(light, color=(0.10, 0.04, 0.08)):
        """A dark purple pixel whose albedo is grey, under `light` times its own light."""
        encoded = np.float32(color)
        photo = Image(encoded[None, None])
        albedo = np.ones((1, 1, 3), np.float32)
        own = np.full((1, 1), encoded.mean(), np.float32)
        detail = split(photo, albedo, own)
        return recombined(photo, albedo, own * np.float32(light), detail).pixels[0, 0]

    def test_fades_the_color_of_a_shadow(self):
        """The more light is added, the nearer the pixel's color is to the albedo's."""
        tints = [np.ptp(found) / found.mean() for found in map(self.lit, (1, 1.5, 2.5, 6))]
        assert all(after < 0.7 * before for before, after in pairwise(tints))

    def test_keeps_the_brightness(self):
        """As much is added as without the fading: what the albedo reflects."""
        assert self.lit(3).mean() == pytest.approx(3 * 0.22 / 3, rel=1e-4)

    def test_without_added_light_the_photo_stays(self):
        """Continuous there, too."""
        np.testing.assert_allclose(self.lit(1), [0.10, 0.04, 0.08], atol=1e-6)
        np.testing.assert_allclose(self.lit(1.001), self.lit(1), atol=1e-3)

    def test_a_black_rendering_fades_nothing(self):
        """Where the estimated light leaves nothing, the photo's pixel stays in the picture."""
        photo = Image(np.float32([[[0.10, 0.04, 0.08]]]))
        detail = split(photo, np.ones((1, 1, 3), np.float32), np.zeros((1, 1), np.float32))
        found = recombined(photo, np.ones((1, 1, 3), np.float32), np.float32([[0.2]]), detail).pixels[0, 0]
        np.testing.assert_allclose(found, np.float32([0.30, 0.24, 0.28]), atol=1e-3)

    def test_black_stays_finite(self):
        """Where the photo has nothing there is no color to fade."""
        assert np.isfinite(self.lit(3, (0, 0, 0))).all()
