"""Strips: every row is worked on once, whatever the shape, and what goes wrong in one is raised."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from graphface.nodes.strips import by_strips


class TestByStrips:
    @given(height=st.integers(0, 400), width=st.integers(0, 3000), channels=st.sampled_from([(), (3,)]))
    def test_every_row_once(self, height, width, channels):
        """No row is left out and none is done twice."""
        times = np.zeros(height, np.int32)

        def work(rows):
            times[rows] += 1

        by_strips(work, (height, width, *channels))
        assert (times == 1).all()

    def test_a_large_picture_has_several_strips(self):
        """Whatever a strip needs beside it stays small."""
        strips = []
        by_strips(strips.append, (1000, 1000, 3))
        assert len(strips) > 10

    def test_an_error_is_raised(self):
        """A failure in one strip is not lost in its thread."""

        def work(rows):
            if rows.start > 0:
                raise ValueError("here")

        with pytest.raises(ValueError, match="here"):
            by_strips(work, (1000, 1000, 3))
