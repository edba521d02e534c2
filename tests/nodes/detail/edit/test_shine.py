"""Bright patches, dimmed or strengthened."""

from __future__ import annotations

import numpy as np

from graphface.nodes.detail.edit.shine import shine


class TestShine:
    def test_shine_only_dims_bright_patches(self, made, landmarks):
        """Making the skin matt never brightens a pixel."""
        matt = shine(made, landmarks, strength=0)
        assert (matt.offset <= made.offset + 1e-6).all()

    def test_strength_one_changes_nothing(self, made, landmarks):
        """The same object."""
        assert shine(made, landmarks, strength=1) is made

    def test_outside_the_mask_nothing_changes(self, made, landmarks):
        """`where` limits the edit."""
        where = np.zeros((40, 50), np.float32)
        where[:, :25] = 1
        edited = shine(made, landmarks, where, strength=0)
        np.testing.assert_array_equal(edited.offset[:, 25:], made.offset[:, 25:])
        assert (edited.offset[:, :25] != made.offset[:, :25]).any() or made.gain is not None
