"""A band of the input's detail map exchanged for the reference's."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from portraits import eyes_apart

from graphface.nodes.makeup.features import features
from graphface.nodes.transfer.detail import detail
from graphface.nodes.types import DetailMap, Image


@pytest.fixture
def landmarks(make_face):
    return make_face(size=200, scale=0.45)[1]


class TestDetail:
    def test_no_mask_no_change(self, landmarks, rng):
        """Without a mask the very map comes back."""
        own, other = (DetailMap(rng.random((200, 200, 3), np.float32)) for _ in range(2))
        assert detail(own, other, np.zeros((200, 200), np.float32), landmarks) is own

    def test_everything(self, landmarks, rng):
        """With all frequencies and a full mask it is the reference's map."""
        own, other = (DetailMap(rng.random((200, 200, 3), np.float32)) for _ in range(2))
        got = detail(own, other, np.ones((200, 200), np.float32), landmarks, broadest=None)
        np.testing.assert_allclose(got.offset, other.offset, atol=1e-6)

    def test_broad_light_stays(self, landmarks):
        """A constant difference, which is light, does not move."""
        own, other = (DetailMap(np.full((200, 200, 3), v, np.float32)) for v in (0.0, 0.3))
        got = detail(own, other, np.ones((200, 200), np.float32), landmarks, broadest=0.2)
        np.testing.assert_allclose(got.offset, 0, atol=1e-3)

    def test_lips_stay_as_dark_as_they_are(self, landmarks):
        """A neutral lipstick darkens all of the lips, which is no relief; the lines in them are."""
        parts = features(Image(np.zeros((200, 200, 3), np.float32)), landmarks)
        lines = (np.arange(200) % 4 < 2).astype(np.float32)[None, :, None] * 0.1
        own, dark = np.zeros((200, 200, 3), np.float32), -0.3 * np.dstack([parts.lips] * 3)
        full, sure = np.ones((200, 200), np.float32), parts.lips > 0.9
        with_lips, without = (
            detail(DetailMap(own), DetailMap(dark + lines), full, landmarks, found).offset for found in (parts, None)
        )
        assert abs(with_lips[sure].mean()) < 0.1
        assert without[sure].mean() < -0.2
        assert with_lips[sure].std() > 0.04

    def test_what_is_too_fine_stays(self, landmarks, rng):
        """Below the finest scale, noise of the reference is not taken."""
        own, noise = (
            DetailMap(np.zeros((200, 200, 3), np.float32)),
            DetailMap(rng.standard_normal((200, 200, 3), np.float32)),
        )
        got = detail(own, noise, np.ones((200, 200), np.float32), landmarks, broadest=None, finest=0.1)
        assert got.offset.std() < 0.1 * noise.offset.std()

    @settings(max_examples=30, deadline=None)
    @given(
        height=st.integers(1, 24),
        width=st.integers(1, 24),
        broadest=st.one_of(st.none(), st.floats(0.01, 2)),
        finest=st.floats(0, 2),
        eyes=st.floats(0, 50),
    )
    def test_any_size_is_finite(self, height, width, broadest, finest, eyes):
        """Single pixels and coincident eyes: finite."""
        random = np.random.default_rng(1)
        own, other = (DetailMap(random.random((height, width, 3), np.float32)) for _ in range(2))
        landmarks = eyes_apart(eyes)
        got = detail(
            own, other, random.random((height, width), np.float32), landmarks, broadest=broadest, finest=finest
        )
        assert np.isfinite(got.offset).all()
