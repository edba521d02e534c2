"""Lips that touch."""

import numpy as np

from graphface.nodes.makeup.closed_mouth import closed_mouth
from graphface.nodes.types import Image

SKIN, LIP, TEETH = np.float32([0.75, 0.55, 0.45]), np.float32([0.6, 0.25, 0.25]), np.float32([0.9, 0.9, 0.85])


def mouth_of(face, inside):
    lips = np.maximum(face.features.lips, face.features.mouth)[..., None] > 0.3
    pixels = np.where(lips, LIP, SKIN * face.everywhere[..., None])
    pixels = np.where((face.features.mouth > 0.3)[..., None], inside, pixels).astype(np.float32)
    return closed_mouth(face.features, Image(pixels), face.landmarks)


class TestClosedMouth:
    def test_the_color_of_lips_is_lip(self, face):
        """A gap with the color of the lips is closed, and belongs to the lips."""
        closed = mouth_of(face, LIP)
        assert closed.mouth.max() < 0.05
        assert closed.lips[face.features.mouth > 0.9].min() > 0.8

    def test_teeth_stay(self, face):
        """An open mouth that shows teeth is left as it is."""
        np.testing.assert_allclose(mouth_of(face, TEETH).mouth, face.features.mouth, atol=1e-5)

    def test_black(self, face):
        """A black photo gives masks in range."""
        closed = closed_mouth(face.features, Image(np.zeros((*face.everywhere.shape, 3), np.float32)), face.landmarks)
        for mask in (closed.mouth, closed.lips):
            assert np.isfinite(mask).all()
            assert 0 <= mask.min() <= mask.max() <= 1
