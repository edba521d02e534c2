"""The color of this face's skin."""

from __future__ import annotations

import numpy as np
from portraits import HAIR, SKIN

from graphface.nodes.masks.skin_color import highlights, skin_weights


class TestSkinWeights:
    def test_other_colors_weigh_little(self, rng):
        """A tenth of the samples, dark as a beard, weighs next to nothing."""
        values = rng.normal(SKIN, 0.02, (20, 10, 3)).astype(np.float32)
        values[:2] = HAIR
        weights = skin_weights(values, np.ones((20, 10), bool)).reshape(20, 10)
        assert weights[:2].max() < 0.05 < 0.5 < weights[2:].mean()

    def test_no_skin(self):
        """Without skin every weight is 0."""
        assert not skin_weights(np.ones((2, 3, 3), np.float32), np.zeros((2, 3), bool)).any()


class TestHighlights:
    def test_lighter_and_of_the_same_hue(self, rng):
        """What is lighter than the skin is a highlight; the skin itself, darker colors and other hues are not."""
        values = rng.normal((0.6, 0.2, 0.2), 0.01, (20, 10, 3)).astype(np.float32)
        weights = skin_weights(values, np.ones((20, 10), bool))
        values[0, :4] = (0.8, 0.2, 0.2), (0.6, 0.2, 0.2), (0.3, 0.2, 0.2), (0.8, -0.4, 0.2)
        found = highlights(values, weights)[:4]
        assert found[0] > 0.8
        assert found[1:].max() < 0.05

    def test_no_skin(self):
        """Without skin there are no highlights."""
        assert highlights(np.ones((2, 3, 3), np.float32), np.zeros(6, np.float32)).max() == 0
