"""sRGB and linear light undo each other; grey is the mean of the channels."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from graphface.nodes.color import channel_mean, decode_srgb, encode_srgb


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
