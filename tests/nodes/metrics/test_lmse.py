"""Local mean squared error."""

from __future__ import annotations

import numpy as np
import pytest

from graphface.nodes.metrics.lmse import lmse
from graphface.nodes.metrics.si_mse import si_mse


@pytest.fixture
def picture(rng):
    return rng.random((60, 50, 3)).astype(np.float32)


class TestLmse:
    def test_local_error_looks_past_slow_shading(self, picture):
        """A slow gain costs `si_mse` more than `lmse`."""
        slow = picture * np.linspace(0.5, 1.5, 50, dtype=np.float32)[None, :, None]
        assert lmse(slow, picture) < 0.5 * si_mse(slow, picture)

    def test_smaller_than_a_window(self):
        """One window, so the figure is `si_mse`."""
        result, truth = np.float32([[1, 1]]), np.float32([[1, 0]])
        assert lmse(result, truth) == pytest.approx(si_mse(result, truth))
