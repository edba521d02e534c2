"""The average face in the pose of the landmarks."""

from __future__ import annotations

import pytest
from faces import coefficients_of, landmarks_of, rotation_of

from graphface.nodes.geometry.average import average
from graphface.nodes.morphable.pose import yaw_pitch_roll


class TestAverage:
    def test_has_the_mean_shape_in_the_right_pose(self):
        """Only the pose is fitted."""
        rotation = rotation_of(25, -5)
        mesh = average(landmarks_of(coefficients=coefficients_of(1), rotation=rotation))
        assert not mesh.fit.identity.any()
        assert yaw_pitch_roll(mesh.fit.rotation)[0] == pytest.approx(25, abs=4)
