"""Foundation: a bounded shift of all skin."""

import numpy as np
import pytest

from graphface.nodes.makeup.foundation import foundation
from graphface.nodes.types import BareSkin, Image, Paint

DARK, PALE = np.float32([0.35, 0.22, 0.16]), np.float32([0.8, 0.65, 0.58])


@pytest.fixture
def shifted(face):
    """The photo of dark skin, and with foundation of a pale reference."""
    photo = Image(DARK * face.everywhere[..., None])
    bare = BareSkin(photo.pixels, 0.02, 0.0, 1.0)
    paint = Paint(face.nowhere, 0 * photo.pixels, PALE)

    def shift(**choices):
        return foundation(photo, bare, paint, face.everywhere, face.surface, face.features, **choices).pixels

    return photo, shift


def lab(color):
    import cv2

    return cv2.cvtColor(np.float32(color)[None, None], cv2.COLOR_RGB2Lab)[0, 0]


class TestFoundation:
    def test_none_by_default(self, shifted):
        """Without strength the photo itself comes back."""
        photo, shift = shifted
        np.testing.assert_array_equal(shift(), photo.pixels)

    def test_bounded(self, shifted, face):
        """Skin moves towards the reference's, by 9 at the most, on and off the mesh alike; the openings stay."""
        photo, shift = shifted
        result = shift(strength=1)
        for place in ((5, 5), np.unravel_index(face.features.nose.argmax(), face.nowhere.shape)):
            moved = lab(result[place]) - lab(DARK)
            assert 8 < np.linalg.norm(moved) < 9.5
            assert moved @ (lab(PALE) - lab(DARK)) > 0
        inside = face.features.openings > 0.999
        np.testing.assert_allclose(result[inside], photo.pixels[inside], atol=2e-3)

    def test_continuous(self, shifted):
        """A little strength changes a little."""
        photo, shift = shifted
        assert 0 < np.abs(shift(strength=0.01) - photo.pixels).max() < 0.02
