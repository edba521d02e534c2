"""Shadow color: dark skin has the color of the lit skin around it."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from shapes import eyes_apart

from graphface.nodes.albedo.shadow_color import shadow_color
from graphface.nodes.face_outlines import LIPS
from graphface.nodes.types import Image, Landmarks

SIDE, INTEROCULAR = 96, 40.0
SKIN, ORANGE = np.float32([1.3, 0.95, 0.75]), np.float32([2.0, 0.8, 0.2])
EVERYWHERE = np.ones((SIDE, SIDE), np.float32)


def spotted(light=0.2, color=ORANGE):
    """Lit skin with a spot of another color and brightness: albedo, shading, and where the spot is."""
    y, x = np.mgrid[:SIDE, :SIDE] - SIDE / 2
    spot = np.hypot(x, y) < 8
    return np.where(spot[..., None], color, SKIN), np.where(spot, light, 0.6).astype(np.float32), spot


def tamed(albedo, shading, mask=EVERYWHERE, interocular=INTEROCULAR, **given):
    return shadow_color(albedo, Image(albedo * shading[..., None]), mask, eyes_apart(interocular), **given)


def saturation(color):
    return 1 - color.min(axis=-1) / color.mean(axis=-1)


class TestShadowColor:
    @pytest.mark.parametrize("color", [ORANGE, np.float32([1.0, 0.6, 1.4]), np.float32([1, 1, 1])])
    def test_a_dark_spot_has_the_color_of_lit_skin(self, color):
        """Whatever its own; its brightness stays."""
        albedo, shading, spot = spotted(color=color)
        found = tamed(albedo, shading)[spot]
        np.testing.assert_allclose(
            found / found.mean(axis=1, keepdims=True), [SKIN / SKIN.mean()] * len(found), atol=0.05
        )
        np.testing.assert_allclose(found.mean(axis=1), color.mean(), rtol=1e-4)

    def test_what_is_no_skin_stays(self):
        """A collar beside the face."""
        albedo, shading, spot = spotted()
        found = tamed(albedo, shading, face=np.where(spot, 0, 1).astype(np.float32))
        np.testing.assert_allclose(found[spot], albedo[spot], rtol=1e-5)

    def test_without_skin_nothing_changes(self):
        """The label is empty."""
        albedo, shading, _ = spotted()
        np.testing.assert_array_equal(tamed(albedo, shading, face=np.zeros_like(EVERYWHERE)), albedo)

    def test_a_spot_on_a_shadow_side_goes_on_differing(self):
        """A purple half of a face takes the hue of the lit half; a mole in it stays redder than what surrounds it."""
        purple, mole = SKIN * np.float32([0.9, 0.7, 1.3]), SKIN * np.float32([1.1, 0.6, 1.0])
        y, x = np.mgrid[:SIDE, :SIDE]
        dark, spot = x >= SIDE // 2, np.hypot(x - 70, y - 48) < 2
        albedo = np.where(spot[..., None], mole, np.where(dark[..., None], purple, SKIN))
        found = tamed(albedo, np.where(dark, 0.3, 0.6).astype(np.float32), black=0.01)
        around, redness = found[48, 80], found[..., 0] / found[..., 1]
        assert (
            np.abs(around / around.mean() - SKIN / SKIN.mean()).max()
            < 0.6 * np.abs(purple / purple.mean() - SKIN / SKIN.mean()).max()
        )
        assert redness[48, 70] > 1.2 * redness[48, 80]

    def test_lips_keep_their_hue(self):
        """Dark lips are not skin in shadow."""
        points = np.zeros((468, 3), np.float32)
        points[263, 0] = INTEROCULAR
        angle = np.linspace(0, 2 * np.pi, len(LIPS), endpoint=False)
        points[list(LIPS), 0], points[list(LIPS), 1] = 48 + 9 * np.cos(angle), 48 + 9 * np.sin(angle)
        albedo, shading, _ = spotted(color=np.float32([1.5, 0.6, 0.9]))
        found = shadow_color(albedo, Image(albedo * shading[..., None]), EVERYWHERE, Landmarks(points, "facemesh468"))
        lip = found[48, 48]
        assert lip[2] > 1.2 * lip[1]

    @pytest.mark.parametrize(("light", "color"), [(0.9, ORANGE), (0.2, SKIN)])
    def test_bright_or_skin_stays(self, light, color):
        """Paint in full light, shadow of the skin's own color."""
        albedo, shading, _ = spotted(light, color)
        np.testing.assert_allclose(tamed(albedo, shading), albedo, atol=0.02)

    def test_may_be_switched_off(self):
        """With both thresholds near 0 nothing counts as dark: the ablations do so."""
        albedo, shading, _ = spotted()
        np.testing.assert_allclose(tamed(albedo, shading, threshold=0.001, black=0.001), albedo, rtol=1e-5)

    def test_sets_in_gradually(self):
        """No edge where a spot is a little darker than another."""
        steps = []
        for light in np.linspace(0.05, 0.9, 90):
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
