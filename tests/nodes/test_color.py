"""Color: sRGB and linear light undo each other, spaces have ranges of about 1."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from graphface.nodes.color import channel_mean, decode_srgb, encode_srgb, in_space, in_three_channels, with_channels_of


class TestEncoding:
    def test_reference_values(self):
        """Middle grey, the knee, and the ends."""
        linear = np.array([0, 0.0031308, 0.2140411, 1, -0.2140411], np.float32)
        np.testing.assert_allclose(encode_srgb(linear), [0, 0.04045, 0.5, 1, -0.5], atol=2e-5)

    @given(hnp.arrays(np.float32, hnp.array_shapes(min_dims=0, max_dims=4), elements=st.floats(-4, 4, width=32)))
    def test_inverse(self, values):
        """Decoding undoes encoding for any shape, below 0 and above 1 too."""
        np.testing.assert_allclose(decode_srgb(encode_srgb(values)), values, atol=2e-6, rtol=2e-6)

    @given(st.floats(-4, 4, width=32), st.floats(-4, 4, width=32))
    def test_monotonic(self, one, other):
        """A brighter value stays at least as bright, across the knees."""
        low, high = sorted([one, other])
        encoded = encode_srgb(np.array([low, high], np.float32))
        assert encoded[0] <= encoded[1] + 1e-6

    def test_every_byte_survives(self):
        """All 256 sRGB levels decode and encode to themselves."""
        levels = np.arange(256, dtype=np.float32) / 255
        np.testing.assert_array_equal(np.rint(encode_srgb(decode_srgb(levels)) * 255), np.arange(256))


class TestChannelMean:
    @given(hnp.arrays(np.float32, (3, 4, 3), elements=st.floats(-4, 4, width=32)))
    def test_mean(self, pixels):
        """The mean of R, G and B at every pixel, float32."""
        mean = channel_mean(pixels)
        assert mean.dtype == np.float32
        np.testing.assert_allclose(mean, pixels.astype(np.float64).mean(axis=2), atol=1e-6)

    def test_a_map_without_channels(self):
        """What is grey already is the same object."""
        grey = np.ones((2, 2), np.float32)
        assert channel_mean(grey) is grey

    def test_the_input_is_left_alone(self):
        """It works on copies: values on wires are shared."""
        pixels = np.ones((2, 2, 3), np.float32)
        channel_mean(pixels)
        assert (pixels == 1).all()


class TestInSpace:
    @pytest.mark.parametrize("space", ["rgb", "lab", "ycrcb", "hsv"])
    def test_ranges_are_about_one(self, space, rng):
        """No channel dominates a distance."""
        found = in_space(rng.random((20, 20, 3)).astype(np.float32), space)
        assert found.dtype == np.float32
        assert np.abs(found).max() <= 2.6
        assert (np.ptp(found, axis=(0, 1)) > 0.4).all()

    def test_hue_is_continuous_at_red(self):
        """A little towards yellow and a little towards magenta are near each other."""
        reds = np.float32([[[1, 0.02, 0], [1, 0, 0.02]]])
        one, other = in_space(reds, "hsv")[0]
        assert np.linalg.norm(one - other) < 0.1


class TestChannels:
    @pytest.mark.parametrize("dtype", [np.float32, np.float64])
    def test_in_three_channels(self, dtype):
        """The same map three times, in a new array, empty ones too."""
        for shape in ((2, 3), (0, 3)):
            values = np.random.default_rng(0).random(shape).astype(dtype)
            np.testing.assert_array_equal(in_three_channels(values), np.stack([values] * 3, axis=2))

    def test_with_channels_of(self):
        """Only a map without channels beside one that has them is repeated."""
        grey, color = np.ones((2, 2), np.float32), np.ones((2, 2, 3), np.float32)
        assert with_channels_of(grey, color).shape == (2, 2, 3)
        assert with_channels_of(grey, grey) is grey
        assert with_channels_of(color, color) is color
