"""Frequency bands, scaled."""

from __future__ import annotations

import numpy as np

from graphface.nodes.detail.edit.bands import bands
from graphface.nodes.detail.edit.frequencies import EDGES, decomposed, gaussian


class TestBands:
    def test_zero_removes_the_bands(self, made, landmarks):
        """With every band at 0 only the broad part is left."""
        bare = bands(made, landmarks, pores=0, lines=0, folds=0)
        np.testing.assert_allclose(bare.offset, gaussian(made.offset, EDGES[-1] * 100), atol=1e-5)

    def test_one_changes_nothing(self, made, landmarks):
        """The same object."""
        assert bands(made, landmarks) is made

    def test_two_doubles_a_band(self, made, landmarks):
        """And leaves the others."""
        fine, *_ = decomposed(made.offset, landmarks)
        np.testing.assert_allclose(bands(made, landmarks, pores=2).offset, made.offset + fine, atol=1e-6)
