"""Landmarks in a copy of another size."""

from __future__ import annotations

import numpy as np

from graphface.nodes.landmarks.scaled import scaled
from graphface.nodes.types import Image, Landmarks

PHOTO = Image(np.zeros((40, 80, 3), np.float32))


def test_corners_stay_corners():
    """Pixels have their middles at integers: the picture reaches from -0.5 to its size less 0.5."""
    points = np.float32([[-0.5, -0.5, 4], [79.5, 39.5, 8]])
    copy = Image(np.zeros((10, 20, 3), np.float32))
    found = scaled(Landmarks(points, "ibug68"), PHOTO, copy).points
    np.testing.assert_allclose(found, [[-0.5, -0.5, 1], [19.5, 9.5, 2]], atol=1e-5)


def test_the_same_size_is_the_same_object():
    """Nothing is copied."""
    points = Landmarks(np.zeros((68, 3), np.float32), "ibug68")
    assert scaled(points, PHOTO, PHOTO) is points
