"""Poses and rotations."""

from __future__ import annotations

import numpy as np
import pytest
from faces import rotation_of

from graphface.nodes.morphable.builtin import builtin_model
from graphface.nodes.morphable.pose import closed_form, rotated, yaw_pitch_roll


class TestPose:
    @pytest.mark.parametrize(("yaw", "pitch", "roll"), [(0, 0, 0), (40, 10, -30), (-70, -20, 90), (10, 0, 170)])
    def test_closed_form_is_exact_on_exact_points(self, yaw, pitch, roll):
        """A rigid shape's pose is found from its projection, rolled by any angle."""
        shape, rotation = builtin_model().mean.astype(float), rotation_of(yaw, pitch, roll)
        pose = closed_form(shape, 80 * (shape @ rotation.T)[:, :2] + (5, -7))
        np.testing.assert_allclose(pose.rotation, rotation, atol=1e-3)
        assert pose.scale == pytest.approx(80, rel=1e-3)

    @pytest.mark.parametrize(("yaw", "pitch", "roll"), [(0, 0, 0), (40, 0, 0), (0, 25, 0), (0, 0, -50), (30, -10, 20)])
    def test_angles_come_back(self, yaw, pitch, roll):
        """Yaw and pitch are where the face looks; roll its lean about that direction."""
        found = yaw_pitch_roll(rotation_of(yaw, pitch, roll))
        np.testing.assert_allclose(found, (yaw, pitch, roll), atol=1e-6)

    def test_turning_keeps_rotations(self):
        """Many turns later the matrix is still orthonormal."""
        rotation = np.eye(3)
        for _ in range(500):
            rotation = rotated(rotation, np.array([0.3, -0.2, 0.5]))
        np.testing.assert_allclose(rotation @ rotation.T, np.eye(3), atol=1e-12)
