"""Features of pixels."""

from __future__ import annotations

import numpy as np
import pytest
from portraits import portrait

from graphface.nodes.masks.features import features, pixel_features
from graphface.testing import check_node


class TestPixelFeatures:
    def test_resolution(self):
        """The inter-ocular distance has as many pixels as asked for."""
        photo, landmarks, _ = portrait()
        found = pixel_features(photo, landmarks, resolution=20)
        assert found.window.scale * landmarks.interocular == pytest.approx(20, abs=0.5)
        assert found.values.shape == (found.window.height, found.window.width, 11)

    def test_node(self):
        """It keeps an operator's promises."""
        check_node(pixel_features, *portrait(120)[:2])


class TestFeatures:
    @pytest.mark.parametrize("space", ["lab", "rgb", "ycrcb", "hsv"])
    def test_finite_for_anything(self, space, rng):
        """NaN and values out of range are replaced; colors have a range of about one."""
        pixels = rng.uniform(-1, 2, (12, 12, 3)).astype(np.float32)
        pixels[0, 0], pixels[1, 1] = np.nan, np.inf
        found = features(pixels, space=space)
        assert found.shape == (12, 12, 11)
        assert np.isfinite(found).all()
        assert np.abs(found).max() < 3

    def test_color_alone(self, rng):
        """Without texture there are three features."""
        assert features(rng.uniform(0, 1, (4, 4, 3)).astype(np.float32), kind="color").shape == (4, 4, 3)
