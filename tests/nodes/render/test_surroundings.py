"""What the picture beyond the face takes its shading from."""

from __future__ import annotations

import numpy as np
import pytest
from shapes import eyes_apart

from graphface import GraphfaceWarning
from graphface.nodes.render.surroundings import surroundings
from graphface.nodes.types import (
    Surface,
)

SIDE, INTEROCULAR = 160, 40.0


def face(side=SIDE, radius=45, soft=10.0):
    """A round face: its surface and its soft mask."""
    y, x = np.mgrid[:side, :side] - side // 2
    distance = np.hypot(x, y)
    coverage = (distance <= radius).astype(np.float32)
    flat = np.zeros((side, side, 3), np.float32)
    mask = np.clip((radius - distance) / soft, 0, 1).astype(np.float32)
    return Surface(flat, coverage * 0, coverage, np.zeros((side, side), np.int32), flat), mask


SURFACE, MASK = face()
LANDMARKS = eyes_apart(INTEROCULAR)


class TestSurroundings:
    def test_each_side_takes_its_own(self):
        """Left of the face the nearest block is on its left edge, right of it on its right."""
        found = surroundings(MASK, SURFACE, LANDMARKS)
        top, bottom, left, right = found.window
        column = found.nearest % (right - left)
        middle = found.nearest.shape[0] // 2
        assert column[middle, 0] == 0
        assert column[middle, -1] == right - left - 1
        assert found.nearest.max() < (bottom - top) * (right - left)

    def test_far_grows_with_distance(self):
        """0 on the face, 1 four blur widths away."""
        found = surroundings(MASK, SURFACE, LANDMARKS, smoothing=0.05)
        row = found.far[found.far.shape[0] // 2]
        middle = len(row) // 2
        assert row[middle] == 0
        assert row[0] == row[-1] == 1
        assert (np.diff(row[middle:]) >= 0).all()

    def test_blocks_are_as_large_as_the_face_allows(self):
        """At least `resolution` of them between the eyes, and never less than a pixel."""
        assert surroundings(MASK, SURFACE, eyes_apart(100), resolution=32).cell == 3
        assert surroundings(MASK, SURFACE, eyes_apart(10), resolution=32).cell == 1

    def test_an_empty_mask_warns(self):
        """There is nothing to take after."""
        with pytest.warns(GraphfaceWarning, match="mask is empty"):
            assert surroundings(MASK * 0, SURFACE, LANDMARKS).total.size == 0
