"""Closed-form matting of the whole picture, which the band is compared with."""

from __future__ import annotations

import numpy as np

from graphface.nodes.bench.matting_speed import Compared, whole_picture
from graphface.nodes.types import Image, Segmentation


def halves() -> tuple[Image, Segmentation]:
    """A white half that is face and a black one that is hair, with an unsure strip between them."""
    pixels = np.zeros((16, 24, 3), np.float32)
    pixels[:, :12] = 1
    face = np.zeros((16, 24), np.float32)
    face[:, :12] = 1
    face[:, 10:14] = 0.5
    return Image(pixels), Segmentation(face, 1 - face, np.zeros_like(face))


class TestWholePicture:
    def test_edge(self):
        """Within the unknown strip the alphas follow the edge of the picture; they sum to one."""
        photo, labels = halves()
        unknown = labels.face == 0.5
        alphas = whole_picture(photo, labels, unknown, 1e-4)
        assert alphas.shape == (16, 24, 3)
        np.testing.assert_allclose(alphas.sum(axis=2), 1, atol=1e-6)
        assert alphas[:, 10, 0].min() > 0.9
        assert alphas[:, 13, 0].max() < 0.1


def test_ratio():
    """How many times dearer the whole picture is."""
    assert Compared("a", (4, 4), 0.5, 3.0, 1.5, 0.0, 0.0).ratio == 2
