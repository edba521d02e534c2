"""What the three methods of blending a layer onto a picture have in common."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from portraits import eyes_apart

from graphface import load
from graphface.nodes.blend.linear import linear
from graphface.nodes.blend.multiband import multiband
from graphface.nodes.blend.poisson import poisson
from graphface.nodes.types import Image

METHODS = [linear, multiband, poisson]
FACE = eyes_apart(40)


def pictures(seed: int, height: int = 48, width: int = 64):
    rng = np.random.default_rng(seed)
    return Image(rng.random((height, width, 3), np.float32)), Image(rng.random((height, width, 3), np.float32))


@pytest.mark.parametrize("method", METHODS)
class TestBlend:
    def test_no_mask_no_change(self, method):
        """An empty mask returns the base to the last bit."""
        base, layer = pictures(1)
        np.testing.assert_array_equal(method(base, layer, np.zeros((48, 64), np.float32), FACE).pixels, base.pixels)

    def test_equal_layers(self, method):
        """A layer that is the base changes nothing, whatever the mask."""
        base, _ = pictures(2)
        mask = np.random.default_rng(3).random((48, 64), np.float32)
        np.testing.assert_allclose(method(base, base, mask, FACE).pixels, base.pixels, atol=1e-5)

    def test_far_from_the_mask_nothing_changes(self, method):
        """A mask in one corner leaves the other corner as it is."""
        base, layer = pictures(4, 128, 128)
        mask = np.zeros((128, 128), np.float32)
        mask[:16, :16] = 1
        np.testing.assert_array_equal(method(base, layer, mask, FACE).pixels[100:, 100:], base.pixels[100:, 100:])

    def test_deep_inside_it_is_the_layer(self, method):
        """A new tone is kept inside: that is what makeup is for."""
        base, layer = (Image(np.full((200, 200, 3), v, np.float32)) for v in (0.3, 0.7))
        mask = np.zeros((200, 200), np.float32)
        mask[20:180, 20:180] = 1
        np.testing.assert_allclose(method(base, layer, mask, FACE).pixels[90:110, 90:110], 0.7, atol=0.02)

    @settings(max_examples=25, deadline=None)
    @given(height=st.integers(1, 40), width=st.integers(1, 40), seed=st.integers(0, 99), eyes=st.floats(0, 100))
    def test_any_size_is_finite(self, method, height, width, seed, eyes):
        """Single pixels, single rows, eyes in one point: finite, and of the right shape."""
        base, layer = pictures(seed, height, width)
        mask = np.random.default_rng(seed).random((height, width), np.float32)
        got = method(base, layer, mask, eyes_apart(eyes)).pixels
        assert got.shape == base.pixels.shape
        assert np.isfinite(got).all()


class TestFamily:
    @pytest.mark.parametrize("name", ["blend.multiband", "blend.poisson"])
    def test_interchangeable(self, name):
        """Each may take the place of the plain mixture in a graph."""
        graph = load("makeup", replace={"blended": name})
        assert name in {step.operator.name for step in graph.steps}
