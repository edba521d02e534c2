"""Loose hair over the face that was labelled skin."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from graphface.nodes.makeup.features import features
from graphface.nodes.makeup.loose_hair import loose_hair
from graphface.nodes.types import Image, Landmarks, Segmentation

HAIR, SKIN = (0.25, 0.18, 0.1), (0.85, 0.7, 0.62)


@pytest.fixture
def portrait(make_face, rng):
    """Skin with hair along the left edge, of which the labels know the outer part; its features and landmarks."""
    photo, landmarks, *_ = make_face(size=200, scale=0.45)
    pixels = np.full((200, 200, 3), SKIN, np.float32)
    pixels[:, :50] = HAIR
    pixels += rng.normal(0, 0.01, pixels.shape).astype(np.float32)
    hair = np.zeros((200, 200), np.float32)
    hair[:, :30] = 1
    return photo.with_pixels(pixels), _labels(hair), features(photo, landmarks), landmarks


def _labels(hair):
    return Segmentation(face=1 - hair, hair=hair, background=np.zeros_like(hair))


class TestLooseHair:
    def test_a_strand_connected_to_hair(self, portrait):
        """What has the hair's color and touches it is not skin; skin stays."""
        photo, labels, parts, landmarks = portrait
        free = parts.eyes + parts.mouth + parts.lips + parts.lids + parts.brows == 0
        left = loose_hair(labels.face, photo, labels, parts, landmarks)
        strand = np.zeros_like(free)
        strand[:, 32:46] = True
        assert left[strand & free].mean() < 0.05
        assert left[:, 70:].min() == 1

    def test_paint_off_the_hair(self, portrait):
        """Paint that does not touch the hair stays, though it is as dark."""
        photo, labels, parts, landmarks = portrait
        pixels = photo.pixels.copy()
        pixels[60:70, 120:180] = HAIR
        left = loose_hair(labels.face, photo.with_pixels(pixels), labels, parts, landmarks)
        assert left[:, 70:].min() == 1

    def test_hair_like_skin(self, portrait):
        """Where hair and skin have one color they cannot be told apart: the very mask is returned."""
        photo, labels, parts, landmarks = portrait
        plain = photo.with_pixels(np.full_like(photo.pixels, 0.5))
        assert loose_hair(labels.face, plain, labels, parts, landmarks) is labels.face

    def test_no_hair(self, portrait):
        """Without labelled hair there is no color model, and nothing is taken out."""
        photo, _, parts, landmarks = portrait
        bald = _labels(np.zeros((200, 200), np.float32))
        assert loose_hair(bald.face, photo, bald, parts, landmarks) is bald.face

    def test_given(self, portrait):
        """A user's mask is returned as it is."""
        photo, labels, parts, landmarks = portrait
        mine = np.full((200, 200), 0.7, np.float32)
        assert loose_hair(labels.face, photo, labels, parts, landmarks, mine) is mine

    @settings(max_examples=30, deadline=None)
    @given(size=st.tuples(st.integers(1, 40), st.integers(1, 40)), eyes=st.floats(0, 60), seed=st.integers(0, 99))
    def test_any_picture_is_finite(self, size, eyes, seed):
        """Single pixels, coincident eyes, noise: within 0 and the mask."""
        random = np.random.default_rng(seed)
        photo = Image(random.random((*size, 3), np.float32))
        points = random.uniform(0, max(size), (468, 3)).astype(np.float32)
        points[33, :2], points[263, :2] = (0, 0), (eyes, 0)
        landmarks = Landmarks(points, "facemesh468")
        labels = _labels((random.random(size) > 0.5).astype(np.float32))
        left = loose_hair(labels.face, photo, labels, features(photo, landmarks), landmarks)
        assert np.isfinite(left).all()
        assert (left >= 0).all()
        assert (left <= labels.face).all()
