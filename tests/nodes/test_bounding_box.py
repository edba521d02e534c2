"""The part of a picture that holds what is not 0."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from graphface.nodes.bounding_box import bounding_box


class TestBoundingBox:
    def test_nothing(self) -> None:
        """An empty mask, or one without pixels, has no box."""
        assert bounding_box(np.zeros((3, 4))) is None
        assert bounding_box(np.zeros((0, 4))) is None

    @given(arrays(bool, st.tuples(st.integers(1, 9), st.integers(1, 9))), st.integers(0, 12))
    def test_holds_everything_and_touches_it(self, mask: np.ndarray, margin: int) -> None:
        """The box holds all that is not 0, each side lies `margin` pixels off it, or at the picture's border."""
        box = bounding_box(mask, margin)
        if box is None:
            assert not mask.any()
            return
        assert mask[box].sum() == mask.sum()
        rows, columns = np.nonzero(mask)
        for span, found, length in zip(box, (rows, columns), mask.shape, strict=True):
            assert (span.start, span.stop) == (max(0, found.min() - margin), min(length, found.max() + 1 + margin))
