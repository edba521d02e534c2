"""Blending in the gradient domain."""

import numpy as np
from portraits import eyes_apart

from graphface.nodes.blend.linear import linear
from graphface.nodes.blend.poisson import poisson
from graphface.nodes.types import Image

SIZE = 120


def test_the_layer_is_met_gradually():
    """Inside of the edge of a soft mask the result stays nearer to the base than by alpha blending, over `reach`."""
    base, layer = (Image(np.full((SIZE, SIZE, 3), v, np.float32)) for v in (0.3, 0.7))
    ramp = np.clip((np.arange(SIZE, dtype=np.float32) - 20) / 20, 0, 1)
    mask = np.tile(ramp, (SIZE, 1))
    mixed = linear(base, layer, mask, eyes_apart(40)).pixels[60, :, 0]
    short, long = (poisson(base, layer, mask, eyes_apart(40), reach=r).pixels[60, :, 0] for r in (0.1, 0.4))
    assert 0.3 < long[34] < short[34] < mixed[34] - 0.01
    np.testing.assert_allclose(short[80:], 0.7, atol=1e-3)


def test_gradients_are_the_layers():
    """A tone that is off by a constant leaves the layer's texture as it is."""
    texture = np.random.default_rng(0).random((SIZE, SIZE, 3), np.float32) * np.float32(0.2)
    base, layer = Image(np.full((SIZE, SIZE, 3), 0.3, np.float32)), Image(0.5 + texture)
    mask = np.ones((SIZE, SIZE), np.float32)
    mask[:10] = 0
    found = poisson(base, layer, mask, eyes_apart(40)).pixels[40:]
    np.testing.assert_allclose(np.diff(found, axis=0), np.diff(layer.pixels[40:], axis=0), atol=0.02)
