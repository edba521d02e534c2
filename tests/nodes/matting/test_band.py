"""The band of unknown alphas."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from graphface.nodes.matting.band import band_of, hard_alphas, soft_alphas, with_alphas
from graphface.nodes.types import Segmentation


def labels_of(numbers):
    return Segmentation(*(np.float32(np.asarray(numbers) == k) for k in range(3)))


def halves(left, right, width=20):
    """Two labels that meet in the middle of a picture."""
    return labels_of(np.where(np.arange(width) < width // 2, left, right) * np.ones((4, 1), int))


class TestBandOf:
    @pytest.mark.parametrize(("left", "right", "columns"), [(0, 2, range(8, 12)), (1, 2, range(6, 14))])
    def test_width(self, left, right, columns):
        """The band reaches `width` to each side of a border, and `hair_width` between hair and background."""
        band = band_of(halves(left, right), 10.0, width=0.2, hair_width=0.4)
        full = np.zeros((4, 20), bool)
        full[band.part] = band.unknown
        assert np.flatnonzero(full.any(axis=0)).tolist() == list(columns)

    def test_without_a_border(self):
        """One label everywhere has an empty band."""
        assert band_of(labels_of(np.ones((5, 5), int)), 10.0, width=0.2, hair_width=0.4).empty

    @given(arrays(np.int8, st.tuples(st.integers(1, 9), st.integers(1, 9)), elements=st.integers(0, 2)))
    def test_margin(self, numbers):
        """The rectangle has two more pixels on each side, where the picture has them."""
        band = band_of(labels_of(numbers), 1.0, width=1.0, hair_width=1.0)
        assert band.unknown.shape == numbers[band.part].shape
        rows = np.flatnonzero(band.unknown.any(axis=1))
        if len(rows):
            assert rows[0] == min(2, rows[0] + band.part[0].start)


class TestWithAlphas:
    def test_inside_and_outside(self):
        """Alphas stand in the band, the most likely labels outside; all sum to 1."""
        soft = Segmentation(*(np.full((4, 20), v, np.float32) for v in (0.2, 0.3, 0.5)))
        band = band_of(halves(0, 2), 10.0, width=0.2, hair_width=0.4)
        assert (soft_alphas(soft, band) == np.float32([0.2, 0.3])).all()
        found = with_alphas(soft, band, np.full((16, 2), 0.75, np.float32))
        assert found.background[:, 0].tolist() == [1] * 4
        assert found.face[:, 10].tolist() == [0.5] * 4
        np.testing.assert_allclose(found.face + found.hair + found.background, 1, atol=1e-6)


class TestHardAlphas:
    def test_most_likely_label(self):
        """Face and hair are 0 or 1."""
        soft = Segmentation(*(np.float32([[v]]) for v in (0.2, 0.5, 0.3)))
        assert hard_alphas(soft, (slice(None), slice(None))).tolist() == [[[0, 1]]]
