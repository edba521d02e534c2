"""What classifiers see."""

from __future__ import annotations

import numpy as np

from graphface.nodes.masks.features import PixelFeatures
from graphface.nodes.masks.label_weights import LabelWeights
from graphface.nodes.masks.window import Window
from graphface.nodes.pictures.features import draw_pixel_features, draw_weights
from graphface.values.picture import View

WINDOW = Window(0, 4, 0, 5, 4, 5)


def test_channels():
    """Every channel has a tile, with its own scale, and its values under it."""
    values = np.random.default_rng(1).random((4, 5, 3), dtype=np.float32) * [1, 10, 100]
    picture = draw_pixel_features(PixelFeatures(WINDOW, values.astype(np.float32)), View())
    assert picture.pixels.shape == (8, 10, 3)
    np.testing.assert_array_equal(picture.data[:4, 5:, 0], values[..., 1].astype(np.float32))
    assert picture.pixels[:4, 5:].max() == 255


def test_more_than_are_shown():
    """The note counts them."""
    values = np.zeros((4, 5, 40), np.float32)
    assert draw_pixel_features(PixelFeatures(WINDOW, values), View()).note.endswith("15 more")


def test_weights():
    """Layers and weights are counted; none is a sentence."""
    weights = LabelWeights({"a": np.ones((2, 3), np.float32), "b": np.zeros(0, np.float32)})
    assert draw_weights(weights, View()).note.endswith("6 weights in 2 layers")
    assert draw_weights(LabelWeights({}), View()).pixels.size
