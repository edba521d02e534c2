"""The ratio of two skins' lightness."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from graphface import GraphfaceWarning
from graphface.nodes.makeup.tone import lightness_ratio


class TestLightnessRatio:
    def test_only_the_face_counts(self):
        """What the mask leaves out does not change the ratio."""
        mask = np.array([[1, 1, 0, 0]], np.float32)
        of_input, of_reference = np.float32([[0.2, 0.2, 1, 1]]), np.float32([[0.4, 0.4, 0, 0]])
        assert lightness_ratio(of_input, of_reference, mask) == pytest.approx(2)

    def test_an_empty_mask_is_reported(self):
        """Without a face to compare the lightness is taken as equal, with a warning."""
        ones = np.ones((4, 4), np.float32)
        with pytest.warns(GraphfaceWarning, match="empty"):
            assert lightness_ratio(ones, ones, 0 * ones) == 1

    @settings(max_examples=50, deadline=None)
    @given(of_input=st.floats(0, 1e6, width=32), of_reference=st.floats(0, 1e6, width=32))
    def test_bounded(self, of_input, of_reference):
        """Black and glaring pictures give a ratio within 1/8 and 8."""
        ones = np.ones((2, 2), np.float32)
        assert 1 / 8 <= lightness_ratio(ones * np.float32(of_input), ones * np.float32(of_reference), ones) <= 8
