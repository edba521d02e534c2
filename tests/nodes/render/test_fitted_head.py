"""The head that is fitted to the points of a face."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from graphface.nodes.geometry.facemesh import facemesh
from graphface.nodes.morphable.topology import facemesh_topology
from graphface.nodes.render.fitted_head import fitted_head
from graphface.nodes.surface.rasterize import rasterize
from graphface.nodes.types import Image, Landmarks

PHOTO = Image(np.full((200, 160, 3), 0.5, np.float32))


def face_mesh(yaw=0.0, unit=50.0, move=0.0):
    turn = np.array([[np.cos(yaw), 0, np.sin(yaw)], [0, 1, 0], [-np.sin(yaw), 0, np.cos(yaw)]])
    points = (facemesh_topology().mean + move) @ turn.T * (unit, -unit, unit) + (80, 80, 0)
    return facemesh(Landmarks(points.astype(np.float32), "facemesh468"))


class TestFittedHead:
    def test_covers_face_skull_and_neck(self):
        """The face is covered to its outline, and more above the forehead and below the chin."""
        face, head = (rasterize(mesh, PHOTO).coverage for mesh in (face_mesh(), fitted_head(face_mesh())))
        assert head[face > 0].mean() > 0.99
        assert head[10:30].sum() > face[10:30].sum()
        assert head[146, 80] == 1

    def test_the_face_lies_where_its_points_are(self):
        """Across the line of sight the nearest vertex of the head is close to every point of the face."""
        mesh = face_mesh()
        distance = np.linalg.norm(mesh.vertices[:, None, :2] - fitted_head(mesh).vertices[None, :, :2], axis=2)
        assert distance.min(axis=1).max() < 0.1 * mesh.interocular

    def test_it_is_symmetric_for_a_symmetric_face(self):
        """The mean face looks straight ahead and has the same shape on both sides, as far as the model does."""
        vertices = fitted_head(face_mesh(unit=1.0)).vertices
        assert abs(vertices[:, 0].min() + vertices[:, 0].max()) < 0.05

    def test_it_turns_with_the_face(self):
        """The back of the head of a face that looks to the right lies to the left of it."""
        for yaw in (-0.6, 0.6):
            assert np.sign(fitted_head(face_mesh(yaw)).vertices[:, 0].mean()) == -np.sign(yaw)

    def test_normals_continue_beyond_the_face(self):
        """Along the midline over the forehead normals turn without a jump: there is no rim."""
        normals = rasterize(fitted_head(face_mesh()), PHOTO).normals
        column = normals[20:60, 80]
        assert (column[1:] * column[:-1]).sum(axis=1).min() > np.cos(np.radians(6))

    def test_a_moved_point_moves_the_surface(self):
        """A mouth that lies lower makes the head's mouth lie lower; far from it nothing moves."""
        points = facemesh_topology().mean.copy()
        before = fitted_head(face_mesh(unit=1.0)).vertices
        points[:, 1] -= np.where(np.abs(points[:, 1] + 0.45) < 0.15, 0.1, 0).astype(np.float32)
        landmarks = Landmarks((points * (1, -1, 1)).astype(np.float32), "facemesh468")
        moved = fitted_head(facemesh(landmarks)).vertices - before
        assert moved[:, 1].min() < -0.05
        assert np.abs(moved[before[:, 1] > 1]).max() < 0.15

    @settings(max_examples=40, deadline=None)
    @given(st.floats(-3.2, 3.2), st.sampled_from([1e-3, 1.0, 50.0, 1e4]))
    def test_any_turn_and_size(self, yaw, unit):
        """Normals stay unit vectors, vertices finite, triangles within the vertices."""
        mesh = fitted_head(face_mesh(yaw, unit))
        assert np.isfinite(mesh.vertices).all()
        np.testing.assert_allclose(np.linalg.norm(mesh.normals, axis=1), 1, atol=1e-4)
        assert mesh.triangles.max() < len(mesh.vertices)

    def test_some_points_may_be_missing(self):
        """Without the points of one side the head is nearly the same."""
        mesh = face_mesh()
        known = np.arange(468, dtype=np.int32)
        known[facemesh_topology().mean[:, 0] > 0.5] = -1
        whole, part = fitted_head(mesh), fitted_head(replace(mesh, facemesh=known))
        moved = np.linalg.norm(whole.vertices - part.vertices, axis=1)
        assert moved.mean() < 0.05 * mesh.interocular
        assert moved.max() < 0.25 * mesh.interocular

    @pytest.mark.parametrize("known", [np.full(468, -1, np.int32), None])
    def test_unknown_points(self, known, recwarn):
        """A mesh that does not know FaceMesh's points is returned as it is."""
        mesh = replace(face_mesh(), facemesh=known)
        assert fitted_head(mesh) is mesh

    def test_points_of_no_face(self):
        """Points in disorder have no pose; the mesh is returned as it is."""
        mesh = face_mesh()
        noise = np.random.default_rng(0).normal(0, 50, mesh.vertices.shape).astype(np.float32)
        mesh = replace(mesh, vertices=noise)
        assert fitted_head(mesh) is mesh

    @pytest.mark.parametrize("changed", [{"deviation": 0}, {"identity": 0}, {"noise": 1e-6, "depth_noise": 1e-6}])
    def test_extreme_settings(self, changed):
        """A rigid model, one without identities, and points that are taken to be exact: a finite head."""
        assert np.isfinite(fitted_head(face_mesh(), **changed).vertices).all()
