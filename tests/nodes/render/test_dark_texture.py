"""The brightness below which skin is too noisy to be lit."""

from __future__ import annotations

import numpy as np
import pytest

from graphface.nodes.render.dark_texture import rough_below
from graphface.nodes.types import Landmarks

SIDE = 240


def half_in_shadow(dark, noise, side=SIDE):
    """A face whose texture is 2 % of its brightness; its left half has a brightness and noise of its own."""
    random = np.random.default_rng(0)
    light = np.where(np.arange(side) < side // 2, dark, 0.6)[None] * np.ones((side, 1))
    picture = light * (1 + 0.02 * random.normal(size=light.shape)) + (light < 0.5) * noise * random.normal(
        size=light.shape
    )
    return np.clip(picture, 0, 1).astype(np.float32)


def eyes(side=SIDE):
    points = np.zeros((68, 3), np.float32)
    points[36, :2], points[45, :2] = (0.3 * side, 0.4 * side), (0.7 * side, 0.4 * side)
    return Landmarks(points, "ibug68")


def everywhere(side=SIDE):
    return np.ones((side, side), np.float32)


class TestRoughBelow:
    def test_clean_shadow_is_lit(self):
        """Skin has the same texture relative to its brightness in light and in shadow."""
        assert rough_below(half_in_shadow(0.13, 0), everywhere(), eyes(), 3) == 0

    @pytest.mark.parametrize("dark", [0.05, 0.09, 0.13])
    def test_noise_is_found_where_it_is(self, dark):
        """The bound lies above the brightness of the noisy half."""
        found = rough_below(half_in_shadow(dark, 0.15 * dark), everywhere(), eyes(), 3)
        assert dark < found <= 0.15

    def test_more_is_allowed_with_a_larger_factor(self):
        """`rougher` is a factor between the textures."""
        picture = half_in_shadow(0.13, 0.013)
        assert [rough_below(picture, everywhere(), eyes(), factor) > 0 for factor in (2, 20)] == [True, False]

    def test_noise_off_the_skin_does_not_count(self):
        """Only the mask is looked at."""
        skin = everywhere()
        skin[:, : SIDE // 2] = 0
        assert rough_below(half_in_shadow(0.13, 0.05), skin, eyes(), 3) == 0

    @pytest.mark.parametrize("value", [0, 1])
    def test_nothing_to_see(self, value):
        """An even picture, no skin, or landmarks that fall together say nothing."""
        flat = np.full((SIDE, SIDE), value, np.float32)
        together = Landmarks(np.zeros((68, 3), np.float32), "ibug68")
        assert rough_below(flat, everywhere(), eyes(), 3) == 0
        assert rough_below(half_in_shadow(0.1, 0.05), 0 * flat, eyes(), 3) == 0
        assert 0 <= rough_below(half_in_shadow(0.1, 0.05), everywhere(), together, 3) <= 0.15
