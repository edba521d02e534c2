"""Difference maps, and the part of pictures worth looking at."""

from __future__ import annotations

import numpy as np

from graphface.ablation.drawing import difference, where_they_differ


class TestDrawing:
    def test_no_difference_is_mid_grey(self):
        """Equal pictures give 128 everywhere, and so do sizes that cannot be compared."""
        one = np.full((4, 5, 3), 77, np.uint8)
        assert (difference(one, one) == 128).all()
        assert (difference(one, one[:2]) == 128).all()

    def test_finds_where_pictures_differ(self):
        """The window holds the one place where they do."""
        one = np.zeros((100, 120, 3), np.uint8)
        other = one.copy()
        other[70:75, 20:25] = 200
        left, top, width, height = where_they_differ([one, other]) or (0, 0, 0, 0)
        assert (left <= 20, left + width >= 25) == (True, True)
        assert (top <= 70, top + height >= 75) == (True, True)

    def test_equal_pictures_have_no_such_place(self):
        """None, rather than any window."""
        one = np.zeros((10, 10, 3), np.uint8)
        assert where_they_differ([one, one]) is None
