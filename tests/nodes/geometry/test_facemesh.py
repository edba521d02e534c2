"""Geometry from FaceMesh points: triangulation, orientation, normals."""

from __future__ import annotations

from collections import Counter

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from graphface import UsageError
from graphface.nodes.geometry.facemesh import facemesh
from graphface.nodes.morphable.normals import vertex_normals
from graphface.nodes.morphable.topology import facemesh_topology, learn_topology
from graphface.nodes.types import Landmarks


def landmarks_of(shape, scale=100.0, center=(200.0, 150.0)):
    """The mean shape as a network would report it: pixels, y down."""
    points = shape * (scale, -scale, scale) + (*center, 0)
    return Landmarks(points.astype(np.float32), "facemesh468")


class TestTopology:
    def test_every_point_is_used(self):
        """All 468 points are corners of some triangle."""
        assert set(facemesh_topology().triangles.ravel()) == set(range(468))

    def test_is_one_disc(self):
        """No edge has more than two triangles, and Euler's number is that of a disc: eyes and mouth are covered."""
        triangles = facemesh_topology().triangles
        edges = Counter(tuple(sorted((t[k], t[k - 1]))) for t in triangles.tolist() for k in range(3))
        assert max(edges.values()) == 2
        assert 468 - len(edges) + len(triangles) == 1

    def test_winding_is_consistent(self):
        """Neighbours run along their common edge in opposite directions."""
        directed = Counter((t[k - 1], t[k]) for t in facemesh_topology().triangles.tolist() for k in range(3))
        assert max(directed.values()) == 1

    def test_is_its_own_mirror_image(self):
        """Mirroring the points maps triangles to triangles."""
        topology = facemesh_topology()
        triangles = {tuple(sorted(t)) for t in topology.triangles.tolist()}
        assert {tuple(sorted(t)) for t in topology.mirror[topology.triangles].tolist()} == triangles

    def test_mean_is_symmetric_and_has_unit_size(self):
        """The mean shape is symmetric about x = 0, and its outer eye corners are one apart."""
        topology = facemesh_topology()
        np.testing.assert_allclose(topology.mean[topology.mirror] * (-1, 1, 1), topology.mean, atol=1e-6)
        assert np.linalg.norm(topology.mean[33] - topology.mean[263]) == pytest.approx(1, abs=1e-6)

    def test_learning_recovers_it_from_posed_shapes(self, rng):
        """Learning from turned, scaled, noisy copies of the mean finds the same mirror pairs, and as many triangles."""
        shapes = []
        for _ in range(8):
            rotation = np.linalg.qr(rng.normal(size=(3, 3)))[0]
            rotation *= np.sign(np.linalg.det(rotation))
            noise = rng.normal(scale=1e-4, size=(468, 3))
            shapes.append(
                (facemesh_topology().mean + noise) @ rotation * rng.uniform(50, 500) + rng.normal(size=3) * 100
            )
        learned = learn_topology(np.stack(shapes))
        np.testing.assert_array_equal(learned.mirror, facemesh_topology().mirror)
        assert len(learned.triangles) == len(facemesh_topology().triangles)


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


class TestVertexNormals:
    def test_do_not_depend_on_the_cut_of_a_square(self):
        """A cube corner's normal is the diagonal however its faces are cut into triangles."""
        vertices = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [0, 1, 1]], float)
        cut_one = np.array([[0, 2, 1], [0, 3, 2], [0, 1, 5], [0, 5, 4], [0, 4, 6], [0, 6, 3]], np.int32)
        cut_two = np.array([[0, 3, 1], [1, 3, 2], [0, 1, 4], [1, 5, 4], [0, 4, 3], [4, 6, 3]], np.int32)
        expected = -np.ones(3) / np.sqrt(3)
        for cut in (cut_one, cut_two):
            np.testing.assert_allclose(vertex_normals(vertices, cut)[0], expected, atol=1e-6)

    @given(st.floats(-1e4, 1e4), st.floats(0, 1e-30))
    def test_stay_unit_for_collapsed_triangles(self, place, size):
        """Triangles without area give unit normals, not NaN."""
        vertices = np.array([[place, place, 0], [place + size, place, 0], [place, place + size, 0]])
        normals = vertex_normals(vertices, np.array([[0, 1, 2]], np.int32))
        np.testing.assert_allclose(np.linalg.norm(normals, axis=1), 1, atol=1e-5)
