"""Shadow color: dark skin is at most as saturated as the lit skin around it."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from shapes import eyes_apart

from graphface.nodes.albedo.shadow_color import shadow_color
from graphface.nodes.types import Image

SIDE, INTEROCULAR = 96, 40.0
SKIN, ORANGE = np.float32([1.3, 0.95, 0.75]), np.float32([2.0, 0.8, 0.2])
EVERYWHERE = np.ones((SIDE, SIDE), np.float32)


def spotted(light=0.2, color=ORANGE):
    """Lit skin with a spot of another color and brightness: albedo, shading, and where the spot is."""
    y, x = np.mgrid[:SIDE, :SIDE] - SIDE / 2
    spot = np.hypot(x, y) < 8
    return np.where(spot[..., None], color, SKIN), np.where(spot, light, 0.6).astype(np.float32), spot


def tamed(albedo, shading, mask=EVERYWHERE, interocular=INTEROCULAR):
    return shadow_color(albedo, Image(albedo * shading[..., None]), mask, eyes_apart(interocular))


def saturation(color):
    return 1 - color.min(axis=-1) / color.mean(axis=-1)


class TestShadowColor:
    def test_a_dark_spot_is_no_more_saturated_than_skin(self):
        """Its brightness stays."""
        albedo, shading, spot = spotted()
        found = tamed(albedo, shading)[spot]
        np.testing.assert_allclose(saturation(found), saturation(SKIN), rtol=0.1)
        np.testing.assert_allclose(found.mean(axis=1), ORANGE.mean(), rtol=1e-4)

    def test_hue_stays(self):
        """The order and the relative distances of the channels."""
        albedo, shading, spot = spotted()
        found = tamed(albedo, shading)[spot][0]
        own = (ORANGE[1] - ORANGE[2]) / (ORANGE[0] - ORANGE[2])
        assert (found[1] - found[2]) / (found[0] - found[2]) == pytest.approx(own, rel=1e-4)

    @pytest.mark.parametrize(("light", "color"), [(0.6, ORANGE), (0.2, SKIN), (0.2, np.float32([1, 1, 1]))])
    def test_bright_or_pale_stays(self, light, color):
        """Lips in full light, shadow of the skin's own color, grey hair."""
        albedo, shading, _ = spotted(light, color)
        np.testing.assert_allclose(tamed(albedo, shading), albedo, atol=0.02)

    def test_sets_in_gradually(self):
        """No edge where a spot is a little darker than another."""
        steps = []
        for light in np.linspace(0.05, 0.6, 60):
            albedo, shading, spot = spotted(light)
            steps.append(saturation(tamed(albedo, shading)[spot]).mean())
        assert np.abs(np.diff(steps)).max() < 0.05
        assert steps[0] < steps[-1]

    @given(st.integers(1, 24), st.integers(1, 24), st.floats(0, 1e4), st.integers(0, 2**32 - 1))
    def test_any_picture(self, height, width, interocular, seed):
        """Finite, not negative, of the same brightness; black, without a face, or of one pixel."""
        rng = np.random.default_rng(seed)
        albedo = rng.choice(np.float32([0, 0.3, 1, 3]), (height, width, 3))
        shading, mask = (rng.choice(np.float32([0, 0.5, 1]), (height, width)) for _ in range(2))
        found = tamed(albedo, shading, mask, interocular)
        assert np.isfinite(found).all()
        assert found.min() >= -1e-6
        np.testing.assert_allclose(found.mean(axis=2), albedo.mean(axis=2), atol=1e-5)
