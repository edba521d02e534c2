"""The head's pose by the FaceMesh points of a face."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from graphface.nodes.morphable.topology import facemesh_topology
from graphface.nodes.render.head_pose import face_points, head_pose

MEAN = facemesh_topology().mean.astype(np.float64)


def turned(degrees):
    angle = np.radians(degrees)
    return np.array([[np.cos(angle), 0, np.sin(angle)], [0, 1, 0], [-np.sin(angle), 0, np.cos(angle)]])


class TestHeadPose:
    @pytest.mark.parametrize("yaw", [-80, 0, 35])
    def test_comes_back(self, yaw):
        """Rotation, scale and origin that a face was posed by."""
        found = head_pose(np.array([3.0, 4, 5]) + 70 * MEAN @ turned(yaw).T, MEAN)
        assert found is not None
        rotation, scale, origin = found
        np.testing.assert_allclose(rotation, turned(yaw), atol=1e-6)
        assert scale == pytest.approx(70)
        np.testing.assert_allclose(origin, [3, 4, 5], atol=1e-4)

    @pytest.mark.parametrize(
        "points", [np.zeros_like(MEAN), MEAN[:50], np.random.default_rng(1).normal(size=MEAN.shape)]
    )
    def test_no_face_has_no_pose(self, points):
        """Too few points, all in one place, or anywhere."""
        assert head_pose(points, MEAN[: len(points)]) is None


class TestFacePoints:
    def test_unknown_points_are_nan(self, make_face):
        """A mesh may know some of them, or none."""
        mesh = make_face()[2]
        assert np.isfinite(face_points(mesh)).all()
        some = mesh.facemesh.copy()
        some[7] = -1
        assert np.isnan(face_points(replace(mesh, facemesh=some))[7]).all()
        assert np.isnan(face_points(replace(mesh, facemesh=None))).all()
