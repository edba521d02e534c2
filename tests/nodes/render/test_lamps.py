"""Lamps: small blown spots of the background keep their light."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from shapes import eyes_apart

from graphface.nodes.render.lamps import lamps
from graphface.nodes.types import Image, Segmentation

SIDE, UNIT = 120, 30.0
WALL = np.ones((SIDE, SIDE), np.float32)


def labels(background=WALL):
    return Segmentation(face=1 - background, hair=np.zeros_like(background), background=background)


def spot(radius, around=0.3, value=1.0):
    """A dark wall with a bright disc, and where the disc is."""
    y, x = np.mgrid[:SIDE, :SIDE]
    disc = np.hypot(x - 80, y - 40) < radius
    return Image(np.repeat(np.where(disc, np.float32(value), np.float32(around))[..., None], 3, axis=2)), disc


class TestLamps:
    def test_a_small_white_spot_is_a_lamp(self):
        """All of it, and nothing far from it."""
        photo, disc = spot(8)
        found = lamps(photo, labels(), eyes_apart(UNIT))
        assert found[disc].min() > 0.5
        assert found[60:, :40].max() == 0

    @pytest.mark.parametrize(
        ("photo", "why"),
        [
            (spot(8, around=0.9)[0], "hardly brighter than the wall"),
            (spot(8, value=0.9)[0], "not blown"),
            (spot(35)[0], "as large as a window"),
        ],
    )
    def test_other_bright_things_are_not(self, photo, why):
        """A white wall, paper and a window take light as everything does."""
        assert lamps(photo, labels(), eyes_apart(UNIT)).max() == 0, why

    def test_a_wall_between_curls_is_not(self):
        """A white wall that thin dark strands cut into pieces is still a wall."""
        pixels = np.full((SIDE, SIDE, 3), 0.96, np.float32)
        pixels[37:53, 57:73] = 0.1
        pixels[40:50, 60:70] = 1
        assert lamps(Image(pixels), labels(), eyes_apart(UNIT)).max() == 0

    def test_a_highlight_on_the_head_is_not(self):
        """Whatever its label."""
        photo, disc = spot(8)
        assert lamps(photo, labels(), eyes_apart(UNIT), disc.astype(np.float32)).max() == 0

    def test_a_highlight_labelled_face_is_not(self):
        """Only the background has lamps."""
        photo, disc = spot(8)
        assert lamps(photo, labels(np.where(disc, 0, 1).astype(np.float32)), eyes_apart(UNIT)).max() == 0

    @given(st.integers(1, 30), st.integers(1, 30), st.floats(0, 1e4), st.integers(0, 2**32 - 1))
    def test_any_picture(self, height, width, interocular, seed):
        """A mask in [0, 1] of the picture's size."""
        rng = np.random.default_rng(seed)
        pixels = rng.choice(np.float32([0, 0.4, 1, 2]), (height, width, 3))
        background = rng.choice(np.float32([0, 1]), (height, width))
        found = lamps(Image(pixels), labels(background), eyes_apart(interocular))
        assert found.shape == (height, width)
        assert np.isfinite(found).all()
        assert found.min() >= 0
        assert found.max() <= 1
