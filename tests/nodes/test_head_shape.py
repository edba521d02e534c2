"""The head that a face sits on: pose from points, solids from the pose."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from portraits import landmarks_at

from graphface import GraphfaceWarning
from graphface.nodes.head_shape import CHIN, cranium, ears, neck, pose_of
from graphface.nodes.landmark_schemes import ibug68
from graphface.nodes.types import Landmarks


class TestPoseOf:
    @given(st.floats(-500, 2000), st.floats(-500, 2000), st.floats(1, 800), st.floats(-3, 3))
    def test_found_again(self, x, y, interocular, roll):
        """Points posed at a place, size and roll give that pose back."""
        pose = pose_of(landmarks_at(x, y, interocular, roll))
        np.testing.assert_allclose(pose.offset, (x, y), atol=0.02 * interocular)
        assert pose.scale == pytest.approx(interocular, rel=0.01)
        assert np.arctan2(pose.rotation[1, 0], pose.rotation[0, 0]) == pytest.approx(roll, abs=0.02)

    def test_68_points_will_do(self):
        """The 68-point scheme gives the same pose."""
        full = landmarks_at(50, 60, 40, 0.2)
        assert pose_of(ibug68(full)).scale == pytest.approx(pose_of(full).scale, rel=1e-3)

    @given(st.integers(0, 2**32 - 1), st.floats(0, 3))
    def test_rotation_is_orthonormal(self, seed, spread):
        """Whatever the points, the rotation is one, and the scale is positive."""
        points = np.random.default_rng(seed).normal(0, spread, (468, 3)).astype(np.float32)
        pose = pose_of(Landmarks(points, "facemesh468"))
        np.testing.assert_allclose(pose.rotation @ pose.rotation.T, np.eye(3), atol=1e-9)
        assert pose.scale > 0

    def test_points_that_are_none(self):
        """Points that are not finite are refused a place, with a warning."""
        points = np.full((468, 3), np.nan, np.float32)
        with pytest.warns(GraphfaceWarning, match="not finite"):
            assert np.isfinite(pose_of(Landmarks(points, "facemesh468")).offset).all()

    def test_locate_undoes_the_roll(self):
        """In the face's own axes the chin is straight below, however the head is tilted."""
        landmarks = landmarks_at(100, 100, 50, 0.6)
        x, y = landmarks.points[152, :2]
        right, high = pose_of(landmarks).locate(np.float32([x]), np.float32([y]))
        assert right[0] == pytest.approx(0, abs=0.01)
        assert high[0] == pytest.approx(CHIN, abs=0.02)


class TestSolids:
    def test_order_from_top_to_bottom(self):
        """The crown is above the face, the neck ends below the chin, the ears are beside."""
        landmarks = landmarks_at(0, 0, 100)
        points, pose = landmarks.points, pose_of(landmarks)
        assert cranium(pose)[:, 1].min() < points[:, 1].min() - 40
        assert neck(pose)[:, 1].max() > points[:, 1].max() + 60
        right, left = ears(pose)
        assert right[:, 0].min() < points[:, 0].min()
        assert left[:, 0].max() > points[:, 0].max()

    def test_grow_with_the_face(self):
        """A face of twice the size has a cranium of twice the size."""
        small, large = (np.ptp(cranium(pose_of(landmarks_at(0, 0, s))), axis=0) for s in (50, 100))
        np.testing.assert_allclose(large, 2 * small, rtol=1e-3)
