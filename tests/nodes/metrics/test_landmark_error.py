"""Error of landmarks."""

from __future__ import annotations

import numpy as np
import pytest

from graphface.nodes.metrics.landmark_error import landmark_error
from graphface.nodes.types import (
    Landmarks,
)


class TestLandmarkError:
    def test_landmark_error_is_relative_to_the_eyes(self):
        """A shift of a tenth of the inter-ocular distance is 0.1; other schemes are refused."""
        points = np.zeros((68, 3), np.float32)
        points[45, 0] = 50
        shifted = points + np.float32([3, 4, 100])
        assert landmark_error(Landmarks(shifted, "ibug68"), Landmarks(points, "ibug68")) == pytest.approx(0.1)
        with pytest.raises(ValueError, match="facemesh468"):
            landmark_error(Landmarks(points, "facemesh468"), Landmarks(points, "ibug68"))
