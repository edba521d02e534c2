"""Training pictures of the label network."""

from __future__ import annotations

import numpy as np
from drawn import PICTURE
from hypothesis import given, settings
from hypothesis import strategies as st

from graphface.nodes.learning.label_pictures import plate_behind


class TestTrainingPicture:
    def test_upright_with_a_margin(self):
        """The middle of the face is the middle of the picture, and is labelled as face."""
        side = PICTURE.labels.shape
        assert PICTURE.labels[side[0] // 2, side[1] // 2, 0] == 255
        assert PICTURE.pixels.shape[:2] == PICTURE.inside.shape == PICTURE.person.shape

    def test_beyond_the_frame(self):
        """Pixels beyond the photo's frame are marked."""
        assert PICTURE.inside[0, 0] == 0
        assert PICTURE.inside.max() == 255


class TestPlateBehind:
    @given(st.integers(0, 20))
    @settings(max_examples=10, deadline=None)
    def test_of_one_color(self, seed):
        """A backdrop of one color is filled in with that color."""
        random = np.random.default_rng(seed)
        person = np.zeros((64, 48), np.float32)
        person[20:40, 16:32] = 1
        pixels = np.full((64, 48, 3), 0.3, np.float32)
        pixels[person > 0] = random.uniform(0, 1, 3)
        np.testing.assert_allclose(plate_behind(pixels, person, np.ones_like(person)), 0.3, atol=0.03)

    def test_no_backdrop(self):
        """Where the person fills the picture the plate is grey."""
        ones = np.ones((40, 40), np.float32)
        np.testing.assert_allclose(plate_behind(np.zeros((40, 40, 3), np.float32), ones, ones), 0.5)
