"""Angle between normals."""

from __future__ import annotations

import numpy as np
import pytest

from graphface.nodes.metrics.normal_angle import normal_angle


class TestNormalAngle:
    def test_right_angle(self):
        """x against y is 90 degrees, whatever the lengths."""
        x, y = np.zeros((3, 3, 3)), np.zeros((3, 3, 3))
        x[..., 0], y[..., 1] = 2, 1
        assert normal_angle(x, y) == pytest.approx(90)

    def test_nothing_in_common_is_an_error(self):
        """Two maps that never meet cannot be compared."""
        with pytest.raises(ValueError, match="no pixel in common"):
            normal_angle(np.zeros((2, 2, 3)), np.ones((2, 2, 3)))
