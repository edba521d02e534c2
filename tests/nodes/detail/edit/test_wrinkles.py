"""Dark lines, smoothed or deepened."""

from __future__ import annotations

import numpy as np

from graphface.nodes.detail.edit.wrinkles import wrinkles


class TestWrinkles:
    def test_wrinkles_only_lift_dark_lines(self, made, landmarks):
        """Smoothing never darkens a pixel."""
        smoothed = wrinkles(made, landmarks, strength=0)
        assert (smoothed.offset >= made.offset - 1e-6).all()

    def test_strength_one_changes_nothing(self, made, landmarks):
        """The same object."""
        assert wrinkles(made, landmarks, strength=1) is made

    def test_outside_the_mask_nothing_changes(self, made, landmarks):
        """`where` limits the edit."""
        where = np.zeros((40, 50), np.float32)
        where[:, :25] = 1
        edited = wrinkles(made, landmarks, where, strength=0)
        np.testing.assert_array_equal(edited.offset[:, 25:], made.offset[:, 25:])
        assert (edited.offset[:, :25] != made.offset[:, :25]).any() or made.gain is not None
