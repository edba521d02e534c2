"""The prior segmentation of heads by the small network."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from portraits import landmarks_at, portrait
from stages import assert_partition, overlaps

from graphface.nodes.masks.cue import cue
from graphface.nodes.masks.label_weights import LabelWeights, shipped_weights
from graphface.nodes.types import Image


class TestCue:
    def test_a_drawn_head(self):
        """Of a drawn head most of the face, of the hair and of the background are found."""
        photo, landmarks, truth = portrait()
        assert min(overlaps(cue(photo, landmarks), truth)) > 0.6

    def test_rolled(self):
        """A photo that lies on its side is labelled like the upright one."""
        photo, landmarks, _ = portrait()
        side = photo.pixels.shape[0]
        points = landmarks.points.copy()
        points[:, 0], points[:, 1] = landmarks.points[:, 1], side - 1 - landmarks.points[:, 0]
        lying = cue(Image(np.ascontiguousarray(np.rot90(photo.pixels))), type(landmarks)(points, "facemesh468"))
        upright = cue(photo, landmarks)
        assert np.abs(np.rot90(upright.face) - lying.face).mean() < 0.01

    def test_size_of_the_photo_matters_little(self):
        """Twice the pixels, the same labels."""
        small, large = (cue(*portrait(side, noise=0)[:2]) for side in (200, 400))
        again = large.hair.reshape(200, 2, 200, 2).mean(axis=(1, 3))
        assert np.abs(again - small.hair).mean() < 0.01

    def test_far_away_is_background(self):
        """Beyond the grid everything is background."""
        photo = Image(np.full((400, 400, 3), 0.5, np.float32))
        labels = cue(photo, landmarks_at(60, 60, 10))
        assert labels.background[200:, 200:].min() == 1

    def test_noise_of_one_level(self):
        """Noise of one 8-bit level changes the labels by next to nothing."""
        photo, landmarks, _ = portrait()
        noise = np.random.default_rng(1).integers(-1, 2, photo.pixels.shape) / 255
        before, after = cue(photo, landmarks), cue(photo.with_pixels(photo.pixels + noise), landmarks)
        assert np.abs(before.hair - after.hair).max() < 0.1
        assert np.abs(before.hair - after.hair).mean() < 0.002

    @pytest.mark.parametrize("value", [0.0, 1.0, 0.4, np.nan, np.inf, -3.0, 1e30])
    def test_flat_pictures(self, value):
        """Black, white, grey and impossible pictures are partitioned."""
        assert_partition(cue(Image(np.full((90, 70, 3), value, np.float32)), landmarks_at(35, 45, 20)))

    @pytest.mark.filterwarnings("ignore::graphface.GraphfaceWarning")
    @settings(deadline=None, max_examples=25)
    @given(
        st.integers(1, 60),
        st.integers(1, 60),
        st.floats(-300, 300),
        st.floats(-300, 300),
        st.floats(0.01, 500),
        st.floats(-3.1, 3.1),
    )
    def test_any_place(self, height, width, x, y, interocular, roll):
        """A photo of a pixel, a face cut by the frame, outside of it, a speck or huge: a partition."""
        photo = Image(np.random.default_rng(0).uniform(0, 1, (height, width, 3)).astype(np.float32))
        assert_partition(cue(photo, landmarks_at(x, y, interocular, roll)))

    @pytest.mark.filterwarnings("ignore::graphface.GraphfaceWarning")
    def test_landmarks_that_are_no_numbers(self):
        """Landmarks of NaN still give labels."""
        landmarks = landmarks_at(30, 30, 10)
        landmarks.points[:] = np.nan
        assert_partition(cue(Image(np.full((60, 60, 3), 0.5, np.float32)), landmarks))

    def test_weights_of_the_users_own(self):
        """A network of zero weights gives every label the same probability."""
        photo, landmarks, _ = portrait()
        zeros = LabelWeights({name: np.zeros_like(values) for name, values in shipped_weights().items()})
        found = cue(photo, landmarks, zeros)
        assert_partition(found)
        np.testing.assert_allclose(found.face[90:110, 90:110], 1 / 3, atol=1e-5)
