"""Exposed skin above the mesh."""

from __future__ import annotations

from typing import ClassVar

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from portraits import HAIR, SKIN, landmarks_at

from graphface.nodes.head_shape import EYE_LINE
from graphface.nodes.masks.exposed_skin import exposed_skin
from graphface.nodes.masks.features import features
from graphface.nodes.masks.layout import layout_of
from graphface.nodes.masks.window import window_about


def described(pixels):
    """Features, sure skin and layout of a picture 160 pixels wide, with a face in its middle."""
    landmarks = landmarks_at(80, 90, 40.0)
    layout = layout_of(landmarks, window_about(landmarks, pixels.shape, 40))
    skin = (layout.outline < -0.05) & (layout.up < EYE_LINE + 0.35) & ~layout.features
    return features(pixels.astype(np.float32), kind="color"), skin, layout


def flat(color, side=160):
    return np.ones((side, side, 3)) * np.asarray(color)


class TestExposedSkin:
    """`exposed_skin`."""

    place: ClassVar = (slice(45, 52), slice(75, 85))

    def test_continues_the_forehead(self):
        """Skin that continues the forehead is found."""
        assert exposed_skin(*described(flat(SKIN)), 40.0)[self.place].min() > 0.9

    def test_ends_at_hair(self):
        """It ends at an edge to hair."""
        pixels = flat(SKIN)
        pixels[:56] = HAIR
        assert exposed_skin(*described(pixels), 40.0)[self.place].max() < 0.05

    def test_not_below_the_eyes(self):
        """At and below the eyes it is 0."""
        values, skin, layout = described(flat(SKIN))
        assert not exposed_skin(values, skin, layout, 40.0)[layout.up <= EYE_LINE].any()

    def test_no_forehead(self):
        """Where no forehead is visible it is 0 everywhere."""
        values, skin, layout = described(flat(SKIN))
        assert not exposed_skin(values, np.zeros_like(skin), layout, 40.0).any()

    @settings(max_examples=20, deadline=None)
    @given(st.integers(0, 99), st.floats(1e-6, 300), st.sampled_from([0.0, 0.02, 1.0]))
    def test_any_picture(self, seed, unit, contrast):
        """Black, flat or noise: values between 0 and 1."""
        pixels = contrast * np.random.default_rng(seed).uniform(size=(160, 160, 3))
        found = exposed_skin(*described(pixels), unit)
        assert found.dtype == np.float32
        assert found.min() >= 0
        assert found.max() <= 1

    @pytest.mark.parametrize("seed", range(3))
    def test_noise(self, seed):
        """Noise of one 8-bit level changes it little."""
        pixels = flat(SKIN)
        pixels[:56] = HAIR
        shaken = pixels + np.random.default_rng(seed).integers(-1, 2, pixels.shape) / 255
        before, after = (exposed_skin(*described(p), 40.0) for p in (pixels, shaken))
        assert np.abs(before - after).mean() < 0.01
