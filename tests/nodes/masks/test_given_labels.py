"""Labels that the user gives."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from graphface import UsageError
from graphface.nodes.masks.given_labels import given_labels
from graphface.nodes.types import Segmentation
from graphface.testing import check_node

unit = arrays(np.float32, (3, 4), elements=st.floats(0, 1, width=32))


@pytest.fixture
def labels():
    return Segmentation(*(np.full((3, 4), v, np.float32) for v in (0.5, 0.3, 0.2)))


class TestGivenLabels:
    def test_none_given(self, labels):
        """Without given masks the computed labels pass as they are."""
        assert given_labels(labels) is labels

    def test_given_wins_and_others_share(self, labels):
        """The other labels share the rest in their own proportion."""
        hair = np.zeros((3, 4), np.float32)
        hair[0, 0] = 1
        found = given_labels(labels, None, hair)
        assert (found.hair == hair).all()
        assert found.face[0, 0] == found.background[0, 0] == 0
        np.testing.assert_allclose(found.face[1], 0.5 / 0.7, rtol=1e-5)

    @given(unit, unit, unit, st.integers(0, 7))
    def test_partition(self, a, b, c, which):
        """Whatever is given, labels lie in [0, 1] and sum to 1."""
        computed = Segmentation(*(np.full((3, 4), v, np.float32) for v in (1.0, 0.0, 0.0)))
        parts = [p if which >> k & 1 else None for k, p in enumerate((a, b, c))]
        found = given_labels(computed, *parts)
        stacked = np.stack([found.face, found.hair, found.background])
        np.testing.assert_allclose(stacked.sum(axis=0), 1, atol=1e-5)
        assert stacked.min() >= 0
        assert stacked.max() <= 1 + 1e-6

    def test_another_size_is_refused(self, labels):
        """The message names the mask and both sizes."""
        with pytest.raises(UsageError, match=r"face mask is 5 x 2 pixels, the photo 4 x 3"):
            given_labels(labels, np.zeros((2, 5), np.float32))

    def test_all_given_need_nothing_computed(self, labels):
        """With every label given, the computed ones may be missing."""
        found = given_labels(None, labels.face, labels.hair, labels.background)
        np.testing.assert_allclose(found.face, 0.5, rtol=1e-6)

    def test_neither_given_nor_computed(self, labels):
        """The message names the operator and the labels that are missing."""
        with pytest.raises(UsageError, match=r"masks.given_labels: .* plugged in for face, background;"):
            given_labels(None, hair=labels.hair)

    def test_node(self, labels):
        """It keeps an operator's promises."""
        check_node(given_labels, labels, labels.hair)
