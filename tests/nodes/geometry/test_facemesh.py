"""Geometry from the landmark network's depth."""

from __future__ import annotations

import numpy as np
import pytest

from graphface import UsageError
from graphface.nodes.geometry.facemesh import facemesh
from graphface.nodes.morphable.topology import facemesh_topology
from graphface.nodes.types import Landmarks


def landmarks_of(shape, scale=100.0, center=(200.0, 150.0)):
    """The mean shape as a network would report it: pixels, y down."""
    points = shape * (scale, -scale, scale) + (*center, 0)
    return Landmarks(points.astype(np.float32), "facemesh468")


class TestFacemesh:
    def test_projects_back_onto_the_landmarks(self):
        """The mesh's camera takes each vertex to its landmark."""
        landmarks = landmarks_of(facemesh_topology().mean)
        mesh = facemesh(landmarks)
        np.testing.assert_allclose(mesh.camera.project(mesh.vertices), landmarks.points[:, :2], atol=1e-3)

    def test_a_frontal_face_looks_at_the_viewer(self):
        """Nearly all normals of a frontal face have positive z, and the nose tip's is the viewer's direction."""
        normals = facemesh(landmarks_of(facemesh_topology().mean)).normals
        assert (normals[:, 2] > 0).mean() > 0.95
        assert normals[4, 2] > 0.9

    def test_depth_flattens(self):
        """`depth` scales z and leaves x and y."""
        landmarks = landmarks_of(facemesh_topology().mean)
        deep, flat = facemesh(landmarks), facemesh(landmarks, depth=0.5)
        np.testing.assert_allclose(flat.vertices, deep.vertices * (1, 1, 0.5), rtol=1e-5)

    def test_refuses_other_schemes(self):
        """Landmarks of another scheme are the user's mistake, named."""
        with pytest.raises(UsageError, match="ibug68"):
            facemesh(Landmarks(np.zeros((68, 3), np.float32), "ibug68"))
