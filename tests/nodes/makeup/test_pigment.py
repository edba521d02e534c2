"""The albedo without the colors of creases and shine, and what lies in front of skin."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from graphface.nodes.makeup.occluders import in_front
from graphface.nodes.makeup.pigment import pigment
from graphface.nodes.types import Features, Landmarks

SIZE = 96
ALL = np.ones((SIZE, SIZE), np.float32)
SKIN = np.float32([1.2, 1.0, 0.8])
NOTHING = Features(*[np.zeros((SIZE, SIZE), np.float32)] * 8)


def eyes_apart(pixels):
    """Landmarks whose only meaning is their unit."""
    points = np.zeros((468, 3), np.float32)
    points[263, 0] = pixels
    return Landmarks(points, "facemesh468")


@pytest.fixture
def skin():
    """Even skin under even light: albedo H x W x 3, shading H x W."""
    return np.tile(SKIN, (SIZE, SIZE, 1)), ALL * np.float32(0.6)


class TestPigment:
    def test_even_skin_stays(self, skin):
        """Where nothing is darker or brighter than its surroundings the albedo is left as it is."""
        albedo, shading = skin
        np.testing.assert_allclose(pigment(albedo, shading, shading, ALL, eyes_apart(64)), albedo, atol=1e-5)

    def test_a_crease_has_the_color_of_the_skin_around(self, skin):
        """A thin dark line that is redder than the skin is a crease: the redness is no pigment."""
        albedo, shading = skin[0].copy(), skin[1].copy()
        albedo[47:50], shading[47:50] = (2.0, 0.6, 0.4), 0.1
        steady = pigment(albedo, shading, skin[1], ALL, eyes_apart(64))
        np.testing.assert_allclose(steady[48], albedo[10], atol=0.05)

    def test_shine_has_the_color_of_the_skin_around(self, skin):
        """A bright white patch is a highlight on the same skin."""
        albedo, shading = skin[0].copy(), skin[1].copy()
        albedo[44:52, 44:52], shading[44:52, 44:52] = 1.0, 1.0
        steady = pigment(albedo, shading, skin[1], ALL, eyes_apart(64))
        np.testing.assert_allclose(steady[48, 48], SKIN, atol=0.05)

    def test_a_broad_dark_color_is_paint(self, skin):
        """A dark lip is broader than a crease and keeps its color."""
        albedo, shading = skin[0].copy(), skin[1].copy()
        albedo[20:76], shading[20:76] = (1.0, 0.5, 1.5), 0.25
        steady = pigment(albedo, shading, skin[1], ALL, eyes_apart(64))
        np.testing.assert_allclose(steady[40:56], albedo[40:56], atol=1e-3)

    def test_colors_come_from_skin_only(self, skin):
        """Green hair beside a crease does not color it."""
        albedo, shading = skin[0].copy(), skin[1].copy()
        albedo[:, 50:] = (0.2, 2.6, 0.2)
        shading[:, 48:50] = 0.1
        mask = ALL.copy()
        mask[:, 50:] = 0
        steady = pigment(albedo, shading, skin[1], mask, eyes_apart(64))
        np.testing.assert_allclose(steady[40:56, 48], np.tile(SKIN, (16, 1)), atol=0.05)

    @settings(max_examples=25, deadline=None)
    @given(
        shading=arrays(np.float32, (12, 10), elements=st.floats(0, 4, width=32)),
        mask=arrays(np.float32, (12, 10), elements=st.floats(0, 1, width=32)),
        apart=st.floats(0, 500),
    )
    def test_between_what_there_was(self, shading, mask, apart):
        """Whatever the light, the mask and the size: finite, and no channel leaves the range of the picture's own."""
        albedo = np.linspace(0, 3, 360, dtype=np.float32).reshape(12, 10, 3)
        steady = pigment(albedo, shading, np.zeros_like(shading), mask, eyes_apart(apart))
        assert np.isfinite(steady).all()
        assert steady.min() >= -1e-3
        assert steady.max() <= 3 + 1e-3


class TestInFront:
    def test_a_rim_is_in_front(self, skin):
        """A thin dark bar, as of glasses, is found, and the skin beside it is not."""
        shading = skin[1].copy()
        shading[46:50] = 0.05
        found = in_front(shading, NOTHING, eyes_apart(64))
        assert found[47:49].min() > 0.9
        assert found[:40].max() == 0

    def test_a_shadow_is_not(self, skin):
        """Half of the face in shade is skin all the same."""
        shading = skin[1].copy()
        shading[:, 48:] = 0.2
        assert in_front(shading, NOTHING, eyes_apart(64))[:, 60:].max() == 0

    def test_brows_are_painted(self, skin):
        """What the brow mask covers is dark by nature and not in front of anything."""
        shading = skin[1].copy()
        shading[46:50] = 0.05
        brows = Features(**{**vars(NOTHING), "brows": ALL})
        assert in_front(shading, brows, eyes_apart(64)).max() == 0

    @settings(max_examples=25, deadline=None)
    @given(shading=arrays(np.float32, (9, 7), elements=st.floats(0, 10, width=32)), apart=st.floats(0, 300))
    def test_a_mask(self, shading, apart):
        """Between 0 and 1, also for a black picture and a face of no size."""
        nothing = Features(*[np.zeros((9, 7), np.float32)] * 8)
        found = in_front(shading, nothing, eyes_apart(apart))
        assert found.min() >= 0
        assert found.max() <= 1
