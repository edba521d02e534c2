"""Beards inside a face that was labelled skin."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from graphface.nodes.makeup.beard import CHIN, beard
from graphface.nodes.makeup.features import features
from graphface.nodes.types import Image, Landmarks

SIZE = 300


@pytest.fixture
def portrait(make_face):
    """Even skin all over, its features and landmarks."""
    photo, landmarks, *_ = make_face(size=SIZE, scale=0.4)
    return np.full((SIZE, SIZE), 0.6, np.float32), features(photo, landmarks), landmarks


def strands(rng):
    """Dark beside bright, from pixel to pixel."""
    return np.where(rng.random((SIZE, SIZE)) > 0.5, 0.8, 0.3).astype(np.float32)


def chin_of(landmarks):
    x, y = landmarks.points[list(CHIN), :2].mean(axis=0).astype(int)
    return np.s_[y - 5 : y + 6, x - 5 : x + 6]


class TestBeard:
    def test_a_beard_is_not_skin(self, portrait, rng):
        """Strands all over the chin are taken out of the mask; cheeks and forehead stay in it."""
        shading, parts, landmarks = portrait
        chin, skin = chin_of(landmarks), np.ones_like(shading)
        bearded = shading.copy()
        below = int(landmarks.points[17, 1])
        bearded[below:] = strands(rng)[below:]
        left = beard(skin, bearded, parts, landmarks)
        assert left[chin].max() < 0.1
        assert left[: int(landmarks.points[2, 1]) - 20].min() == 1

    def test_beside_a_moustache_alone_the_chin_stays(self, portrait, rng):
        """Strands on the upper lip are taken out of the mask, and nothing below the mouth."""
        shading, parts, landmarks = portrait
        skin, bearded = np.ones_like(shading), shading.copy()
        nose, mouth = (int(landmarks.points[k, 1]) for k in (2, 13))
        bearded[nose:mouth] = strands(rng)[nose:mouth]
        left = beard(skin, bearded, parts, landmarks)
        assert left[nose:mouth].min() < 0.1
        assert left[chin_of(landmarks)].min() > 0.9

    def test_a_beard_fades_in(self, portrait, rng):
        """Between too little and enough hair on half a chin the mask changes in small steps, from 1 to 0."""
        shading, parts, landmarks = portrait
        bearded = shading.copy()
        middle = int(landmarks.points[17, 0])
        bearded[int(landmarks.points[17, 1]) :, :middle] = strands(rng)[int(landmarks.points[17, 1]) :, :middle]
        left = [
            beard(np.ones_like(shading), bearded, parts, landmarks, least_share=c) for c in np.linspace(0.3, 0.9, 241)
        ]
        steps = [float(np.abs(one - other).max()) for one, other in pairwise(left)]
        assert max(steps) < 0.15
        assert left[0].min() < 0.1
        assert left[-1].min() > 0.9

    def test_smooth_skin_stays(self, portrait):
        """Without strands the very mask is returned."""
        shading, parts, landmarks = portrait
        skin = np.ones_like(shading)
        assert beard(skin, shading, parts, landmarks) is skin

    def test_a_wrinkle_is_not_a_beard(self, portrait):
        """One line, however dark, does not cover a chin."""
        shading, parts, landmarks = portrait
        skin, wrinkled = np.ones_like(shading), shading.copy()
        wrinkled[int(landmarks.points[199, 1])] = 0.2
        assert beard(skin, wrinkled, parts, landmarks) is skin

    def test_strands_elsewhere(self, portrait, rng):
        """A fringe over the forehead is no beard."""
        shading, parts, landmarks = portrait
        skin, fringed = np.ones_like(shading), shading.copy()
        brows = int(landmarks.points[9, 1])
        fringed[:brows] = strands(rng)[:brows]
        assert beard(skin, fringed, parts, landmarks) is skin

    def test_given(self, portrait, rng):
        """A user's mask is returned as it is."""
        _, parts, landmarks = portrait
        mask = np.full((SIZE, SIZE), 0.25, np.float32)
        assert beard(np.ones_like(mask), strands(rng), parts, landmarks, mask) is mask

    def test_beyond_the_frame(self, portrait):
        """A chin outside of the picture has no beard."""
        shading, parts, landmarks = portrait
        skin, far = np.ones_like(shading), Landmarks(landmarks.points + np.float32(5000), "facemesh468")
        assert beard(skin, shading, parts, far) is skin

    @settings(max_examples=25, deadline=None)
    @given(
        height=st.integers(1, 40),
        width=st.integers(1, 40),
        size=st.floats(0, 60),
        dark=st.floats(0, 1),
        contrast=st.floats(0.01, 2),
    )
    def test_any_size_is_a_mask(self, height, width, size, dark, contrast):
        """Faces of no size, single pixels, black pictures: within 0..1, never more than the skin."""
        rng = np.random.default_rng(0)
        points = (rng.random((468, 3)) * size).astype(np.float32)
        landmarks = Landmarks(points, "facemesh468")
        shading = (rng.random((height, width)) * dark).astype(np.float32)
        parts = features(Image(np.zeros((height, width, 3), np.float32)), landmarks)
        left = beard(np.full((height, width), 0.5, np.float32), shading, parts, landmarks, contrast=contrast)
        assert np.isfinite(left).all()
        assert left.min() >= 0
        assert left.max() <= 0.5
