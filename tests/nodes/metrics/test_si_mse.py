"""Scale-invariant mean squared error."""

from __future__ import annotations

import numpy as np
import pytest

from graphface.nodes.metrics.si_mse import si_mse


class TestSiMse:
    def test_black_is_one(self):
        """As bad as a picture that shows nothing."""
        assert si_mse(np.zeros((3, 3)), np.ones((3, 3))) == pytest.approx(1)

    def test_known_error(self):
        """Half of the power is at right angles to the truth."""
        assert si_mse(np.array([[1.0, 1.0]]), np.array([[1.0, 0.0]])) == pytest.approx(0.5)
