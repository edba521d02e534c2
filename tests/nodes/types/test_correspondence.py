"""Correspondences and pins as values."""

from __future__ import annotations

import numpy as np
import pytest

from graphface.nodes.types import Correspondence, Pins


class TestPins:
    @pytest.mark.parametrize("value", [[1, 2, 3, 4], [[1, 2, 3]], [[1, 2, 3, np.inf]]])
    def test_another_shape(self, value):
        """Arrays are (n, 4) and finite."""
        with pytest.raises(ValueError, match="shape"):
            Pins.coerce(value)


class TestKnown:
    def test_is_the_better_of_both_places(self):
        """Where the point or its mirror image is shown."""
        places, valid, mirrored = np.zeros((1, 2, 2), np.float32), np.float32([[0.2, 1]]), np.float32([[0.7, 0]])
        found = Correspondence(places, valid, valid, (1, 2), places, mirrored)
        np.testing.assert_array_equal(found.known, np.float32([[0.7, 1]]))
        assert Correspondence(places, valid, valid, (1, 2)).known is valid
