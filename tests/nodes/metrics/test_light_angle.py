"""Angle between light directions."""

from __future__ import annotations

import numpy as np
import pytest

from graphface.nodes.metrics.light_angle import light_angle


class TestLightAngle:
    def test_angle_of_directions(self):
        """In degrees; a zero vector is at right angles to everything."""
        x, y = np.float32([1, 0, 0]), np.float32([1, 1, 0])
        assert light_angle(x, y) == pytest.approx(45)
        assert light_angle(x, 0 * x) == 90
