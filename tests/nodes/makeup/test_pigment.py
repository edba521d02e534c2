"""The albedo without the colors of creases and shine."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from portraits import eyes_apart

from graphface.nodes.makeup.pigment import pigment

SIZE = 96
ALL = np.ones((SIZE, SIZE), np.float32)
SKIN = np.float32([1.2, 1.0, 0.8])


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
        result = pigment(albedo, shading, skin[1], ALL, eyes_apart(64))
        np.testing.assert_allclose(result[48], albedo[10], atol=0.05)

    def test_shine_has_the_color_of_the_skin_around(self, skin):
        """A bright white patch is a highlight on the same skin."""
        albedo, shading = skin[0].copy(), skin[1].copy()
        albedo[44:52, 44:52], shading[44:52, 44:52] = 1.0, 1.0
        result = pigment(albedo, shading, skin[1], ALL, eyes_apart(64))
        np.testing.assert_allclose(result[48, 48], SKIN, atol=0.05)

    def test_a_broad_dark_color_is_paint(self, skin):
        """A dark lip is broader than a crease and keeps its color."""
        albedo, shading = skin[0].copy(), skin[1].copy()
        albedo[20:76], shading[20:76] = (1.0, 0.5, 1.5), 0.25
        result = pigment(albedo, shading, skin[1], ALL, eyes_apart(64))
        np.testing.assert_allclose(result[40:56], albedo[40:56], atol=1e-3)

    def test_colors_come_from_skin_only(self, skin):
        """Green hair beside a crease does not color it."""
        albedo, shading = skin[0].copy(), skin[1].copy()
        albedo[:, 50:] = (0.2, 2.6, 0.2)
        shading[:, 48:50] = 0.1
        mask = ALL.copy()
        mask[:, 50:] = 0
        result = pigment(albedo, shading, skin[1], mask, eyes_apart(64))
        np.testing.assert_allclose(result[40:56, 48], np.tile(SKIN, (16, 1)), atol=0.05)

    @settings(max_examples=25, deadline=None)
    @given(
        shading=arrays(np.float32, (12, 10), elements=st.floats(0, 4, width=32)),
        mask=arrays(np.float32, (12, 10), elements=st.floats(0, 1, width=32)),
        apart=st.floats(0, 500),
    )
    def test_between_what_there_was(self, shading, mask, apart):
        """Whatever the light, the mask and the size: finite, and no channel leaves the range of the picture's own."""
        albedo = np.linspace(0, 3, 360, dtype=np.float32).reshape(12, 10, 3)
        result = pigment(albedo, shading, np.zeros_like(shading), mask, eyes_apart(apart))
        assert np.isfinite(result).all()
        assert result.min() >= -1e-3
        assert result.max() <= 3 + 1e-3
