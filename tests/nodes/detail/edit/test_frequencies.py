"""Frequency bands of a detail map."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from graphface.nodes.detail.edit.frequencies import EDGES, decomposed, edited_map, gaussian, guided
from graphface.nodes.types import (
    DetailMap,
)


class TestDecomposed:
    @pytest.mark.parametrize("kernel", ["gaussian", "guided"])
    def test_bands_add_up(self, made, landmarks, kernel):
        """The bands and what is broader than all of them are the map."""
        broad = made.offset - sum(decomposed(made.offset, landmarks, kernel))
        smooth = guided if kernel == "guided" else gaussian
        np.testing.assert_allclose(broad, smooth(made.offset, EDGES[-1] * 100), atol=1e-5)


class TestEditedMap:
    def test_outside_the_mask_nothing_changes(self, made):
        """`where` limits the edit, and blends it in."""
        where = np.zeros((40, 50), np.float32)
        where[:, :20], where[:, 20:25] = 1, 0.5
        edited = edited_map(made, lambda values: values + 1, where)
        np.testing.assert_array_equal(edited.offset[:, 25:], made.offset[:, 25:])
        np.testing.assert_allclose(edited.offset[:, :20], made.offset[:, :20] + 1, atol=1e-6)
        np.testing.assert_allclose(edited.offset[:, 20:25], made.offset[:, 20:25] + 0.5, atol=1e-6)

    @given(st.floats(-1e6, 1e6, width=32))
    def test_a_gain_stays_positive_and_finite(self, change):
        """It is edited by its logarithm."""
        detail = DetailMap(np.zeros((1, 1, 3), np.float32), np.full((1, 1, 3), 0.5, np.float32))
        gain = edited_map(detail, lambda values: values + np.float32(change), None).gain
        assert gain.min() > 0
        assert np.isfinite(gain).all()


class TestGuided:
    def test_keeps_strong_edges(self):
        """A step of 1 stays, where a Gaussian of that width removes it; noise of 1 % is smoothed."""
        step = np.zeros((20, 60), np.float32)
        step[:, 30:] = 1
        noisy = step + 0.01 * np.random.default_rng(0).normal(size=step.shape).astype(np.float32)
        smooth = guided(noisy, 4.0)
        assert smooth[10, 31] - smooth[10, 28] > 0.9
        assert gaussian(noisy, 4.0)[10, 31] - gaussian(noisy, 4.0)[10, 28] < 0.5
        assert smooth[:, :10].std() < 0.5 * noisy[:, :10].std()

    @pytest.mark.parametrize("smooth", [gaussian, guided])
    def test_a_constant_stays(self, smooth):
        """Whatever the width."""
        for sigma in (0.1, 1.0, 50.0):
            np.testing.assert_allclose(smooth(np.full((5, 7), 0.3, np.float32), sigma), 0.3, atol=1e-6)
