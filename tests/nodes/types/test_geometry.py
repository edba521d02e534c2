"""The camera, and the unit of lengths."""

from __future__ import annotations

import numpy as np
import pytest

from graphface.nodes.types import (
    Camera,
    Landmarks,
)


class TestCamera:
    def test_weak_perspective(self):
        """x to the right, y up, any depth alike."""
        camera = Camera(scale=2, center=(10, 20))
        np.testing.assert_allclose(camera.project(np.float64([[1, 3, 0], [1, 3, 50]])), [[12, 14], [12, 14]])

    def test_perspective_is_continuous_with_it(self):
        """A camera very far away sees what one infinitely far away sees; near it, nearer things are larger."""
        points = np.float64([[1, 3, 5]])
        far, weak = (Camera(nearness=n).project(points) for n in (1e-9, 0))
        np.testing.assert_allclose(far, weak, atol=1e-6)
        assert Camera(nearness=0.1).project(points)[0, 0] == pytest.approx(2)

    def test_behind_the_camera_is_finite(self):
        """Points at or behind the camera are not divided by zero."""
        assert np.isfinite(Camera(nearness=1).project(np.float64([[1, 1, 1], [1, 1, 5]]))).all()


class TestLandmarks:
    @pytest.mark.parametrize(
        ("scheme", "count", "corners"), [("facemesh468", 468, (33, 263)), ("ibug68", 68, (36, 45))]
    )
    def test_interocular(self, scheme, count, corners):
        """Between the outer eye corners, in three dimensions."""
        points = np.zeros((count, 3), np.float32)
        points[corners[1]] = (3, 4, 12)
        assert Landmarks(points, scheme).interocular == pytest.approx(13)
