"""The light that the painted face is rendered under."""

import numpy as np
import pytest

from graphface.nodes.makeup.shading import shading


class TestShading:
    def test_lightness_follows_the_reference(self, face):
        """A reference twice as light doubles the shading, but not in the openings of eyes and mouth."""
        ones = face.everywhere
        lit = shading(ones * 0.3, ones * 0.3, ones * 0.6, ones, face.features)
        assert lit[190, 5] == pytest.approx(0.6, rel=1e-5)
        opening = face.features.openings
        np.testing.assert_allclose(lit, 0.3 * (2 - opening), rtol=1e-5)

    def test_no_tone_keeps_the_light(self, face):
        """At tone 0 the shading does not change."""
        ones = face.everywhere
        lit = shading(ones * 0.3, ones * 0.3, ones * 0.6, ones, face.features, tone=0)
        np.testing.assert_allclose(lit, 0.3, rtol=1e-6)

    def test_colored_light(self, face):
        """A shading with three channels keeps them."""
        ones = face.everywhere
        colored = np.full((200, 200, 3), (0.2, 0.3, 0.4), np.float32)
        lit = shading(colored, ones * 0.3, ones * 0.6, ones, face.features)
        np.testing.assert_allclose(lit[190, 5], (0.4, 0.6, 0.8), rtol=1e-5)
