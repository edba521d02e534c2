"""Polygons as masks, and masks grown and shrunk."""

from __future__ import annotations

import numpy as np

from graphface.nodes.masks.polygons import dilated, eroded, filled


class TestFilled:
    def test_a_square(self):
        """Pixels inside and on the edge are 1, parts beyond the frame are cut."""
        square = np.array([[1.0, 1.0], [9.0, 1.0], [9.0, 2.0], [1.0, 2.0]])
        assert filled([square], (4, 4)).tolist() == [[0] * 4, [0, 1, 1, 1], [0, 1, 1, 1], [0] * 4]

    def test_a_speck_sets_a_pixel(self):
        """A polygon smaller than a pixel is not lost."""
        assert filled([np.full((3, 2), 2.1)], (4, 4)).sum() == 1

    def test_not_finite(self):
        """A polygon of NaN and one without corners are left out."""
        assert not filled([np.full((3, 2), np.nan), np.zeros((0, 2))], (4, 4)).any()


class TestErodedAndDilated:
    def test_frame_is_no_edge(self):
        """A full mask stays full when it shrinks, an empty one empty when it grows."""
        full = np.ones((5, 5), np.float32)
        assert eroded(full, 2).all()
        assert not dilated(0 * full, 2).any()

    def test_radius(self):
        """A pixel grows to the disc of the radius."""
        dot = np.zeros((9, 9), np.float32)
        dot[4, 4] = 1
        assert dilated(dot, 2)[4].tolist() == [0, 0, 1, 1, 1, 1, 1, 0, 0]
