"""The hair of the brows."""

import numpy as np

from graphface.nodes.makeup.brow_hair import brow_hair

SKIN = np.float32([0.75, 0.55, 0.45])


def matte(face, color):
    """Of a face whose brows have a color."""
    pixels = SKIN * face.everywhere[..., None]
    pixels = np.where((face.features.brows > 0.5)[..., None], np.float32(color), pixels)
    departure = np.log(pixels + np.float32(0.02)) - np.log(SKIN + np.float32(0.02))
    return brow_hair(pixels, departure, face.features.brows, face.features.eyes, face.landmarks.interocular)


class TestBrowHair:
    def test_dark_hair(self, face):
        """Dark pixels of the brow are hair, the skin around is none."""
        found = matte(face, (0.2, 0.15, 0.12))
        assert found[face.features.brows > 0.9].min() > 0.9
        assert found[face.features.cheeks > 0.5].max() == 0

    def test_blue_is_paint(self, face):
        """A brow painted blue is no hair."""
        assert matte(face, (0.1, 0.2, 0.6)).max() < 0.1

    def test_no_brow(self, face):
        """Where nothing is darker than skin there is no hair."""
        assert matte(face, SKIN).max() == 0
