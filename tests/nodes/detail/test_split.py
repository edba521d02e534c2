"""A ratio for less light, a difference for more."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from graphface import GraphfaceWarning
from graphface.nodes.blend.recombine import recombine
from graphface.nodes.detail.additive import additive
from graphface.nodes.detail.split import split
from graphface.nodes.intrinsic.intensity import intensity
from graphface.nodes.types import (
    Image,
)


class TestSplit:
    """Around the light of the photo: below it a bounded ratio, above it a difference."""

    @pytest.fixture
    def case(self, rng):
        photo = Image(rng.uniform(0.2, 0.5, (8, 9, 3)).astype(np.float32))
        return photo, intensity(photo).albedo, rng.uniform(0.2, 0.5, (8, 9)).astype(np.float32)

    @pytest.mark.parametrize("colored", [False, True])
    def test_same_shading_returns_the_photo(self, photo, colored, rng):
        """Recombined under the light it was made with, the photo comes back within 1/255."""
        shading = rng.uniform(0, 1.2, photo.pixels.shape if colored else photo.pixels.shape[:2]).astype(np.float32)
        albedo = intensity(photo).albedo
        again = recombine(photo, albedo, shading, split(photo, albedo, shading))
        np.testing.assert_allclose(again.pixels, photo.pixels, atol=1 / 255 / 10)

    def test_less_light_scales_the_pixel(self, case):
        """Taking light away scales what is there, highlights included, like the ratio."""
        photo, albedo, shading = case
        made = split(photo, albedo, shading, bound=20, floor=1e-4)
        again = recombine(photo, albedo, shading / 2, made, shoulder=0)
        np.testing.assert_allclose(again.pixels, photo.pixels / 2, atol=0.01)

    def test_more_light_adds(self, case):
        """Adding light changes the pixel by the change of the rendering, like the paper's map."""
        photo, albedo, shading = case
        two = (method(photo, albedo, shading) for method in (split, additive))
        brighter = [recombine(photo, albedo, shading + 0.1, one).pixels for one in two]
        np.testing.assert_allclose(*brighter, atol=1e-5)

    def test_bound_of_one_is_additive(self, case):
        """With a gain of 1 the method is the paper's."""
        np.testing.assert_allclose(split(*case, bound=1).gain, 1, atol=1e-5)

    @settings(max_examples=60, deadline=None)
    @given(st.floats(0, 1, width=32), st.floats(0, 4, width=32), st.floats(1, 20, width=32))
    def test_gain_is_bounded(self, value, shade, bound):
        """Whatever the photo and the estimated shading, the gain is within its bound."""
        photo = Image(np.full((2, 2, 3), value, np.float32))
        albedo = np.ones((2, 2, 3), np.float32)
        gain = split(photo, albedo, np.full((2, 2), shade, np.float32), bound=bound).gain
        assert gain.min() >= 1 / bound * (1 - 1e-4)
        assert gain.max() <= bound * (1 + 1e-4)

    def test_missing_landmarks_are_reported(self, case):
        """A cut-off without landmarks has no unit; the guess is reported."""
        with pytest.warns(GraphfaceWarning, match="no landmarks"):
            split(*case, cutoff=0.1)
