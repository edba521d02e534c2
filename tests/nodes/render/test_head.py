"""The head and the neck behind the face."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from graphface.nodes.geometry.facemesh import facemesh
from graphface.nodes.morphable.topology import facemesh_topology
from graphface.nodes.render.head import head
from graphface.nodes.surface.rasterize import rasterize
from graphface.nodes.types import (
    Image,
    Landmarks,
)

PHOTO = Image(np.full((200, 160, 3), 0.5, np.float32))


def face_mesh(yaw=0.0, unit=50.0):
    turn = np.array([[np.cos(yaw), 0, np.sin(yaw)], [0, 1, 0], [-np.sin(yaw), 0, np.cos(yaw)]])
    points = facemesh_topology().mean @ turn.T * (unit, -unit, unit) + (80, 80, 0)
    return facemesh(Landmarks(points.astype(np.float32), "facemesh468"))


class TestHead:
    def test_the_face_stays_in_front(self):
        """Where the face was seen, the same face is seen: no solid pokes through it."""
        before, after = (rasterize(mesh, PHOTO) for mesh in (face_mesh(), head(face_mesh())))
        seen = before.coverage > 0
        same = after.triangle[seen] == before.triangle[seen]
        assert same.mean() > 0.97

    def test_covers_skull_and_neck(self):
        """More of the picture above the forehead and below the chin is surface now."""
        before, after = (rasterize(mesh, PHOTO).coverage for mesh in (face_mesh(), head(face_mesh())))
        assert after[10:30].sum() > before[10:30].sum()
        assert after[146, 80] == 1
        assert before[146, 80] == 0

    def test_solids_turn_with_the_face(self):
        """The skull of a face that looks to the right lies to the left of it."""
        for yaw in (-0.6, 0.6):
            added = head(face_mesh(yaw)).vertices[468:]
            assert np.sign(added[:, 0].mean()) == -np.sign(yaw)

    @settings(max_examples=40, deadline=None)
    @given(st.floats(-3.2, 3.2), st.sampled_from([1e-3, 1.0, 50.0, 1e4]))
    def test_any_turn_and_size(self, yaw, unit):
        """Normals stay unit vectors, vertices finite, triangles within the vertices."""
        mesh = head(face_mesh(yaw, unit))
        assert np.isfinite(mesh.vertices).all()
        np.testing.assert_allclose(np.linalg.norm(mesh.normals, axis=1), 1, atol=1e-4)
        assert mesh.triangles.max() < len(mesh.vertices)

    def test_no_gap_below_the_jaw(self):
        """From the chin down to the neck there is surface, and it looks downwards before it looks ahead again."""
        surface = rasterize(head(face_mesh(unit=80.0)), Image(np.zeros((400, 160, 3), np.float32)))
        chin = np.flatnonzero(
            rasterize(face_mesh(unit=80.0), Image(np.zeros((400, 160, 3), np.float32))).coverage[:, 80]
        )
        below = slice(chin[-1] - 2, chin[-1] + 30)
        assert surface.coverage[below, 80].all()
        assert surface.normals[below, 80, 1].min() < -0.3
        assert surface.normals[chin[-1] + 28, 80, 2] > 0.8

    def test_the_neck_widens_at_its_foot(self):
        """There light from above arrives."""
        surface = rasterize(head(face_mesh(unit=60.0)), Image(np.zeros((240, 260, 3), np.float32)))
        assert surface.normals[159, 80 + 52, 1] > 0.3
        assert surface.normals[159, 80 - 52, 1] > 0.3

    def test_points_in_another_order(self):
        """A model with vertices of its own has the same head, by the points that it knows."""
        mesh = face_mesh()
        order = np.random.default_rng(1).permutation(468)
        place = np.argsort(order).astype(np.int32)
        other = replace(
            mesh,
            vertices=mesh.vertices[order],
            normals=mesh.normals[order],
            triangles=place[mesh.triangles],
            facemesh=place,
        )
        np.testing.assert_allclose(head(other).vertices[468:], head(mesh).vertices[468:], atol=1e-3)
        some = np.where(np.arange(468) % 30 == 0, -1, place).astype(np.int32)
        apart = head(replace(other, facemesh=some)).vertices[468:] - head(mesh).vertices[468:]
        assert np.abs(apart).max() < 0.1 * mesh.interocular

    def test_unknown_points(self):
        """A mesh without known points is returned as it is, with a warning."""
        mesh = replace(face_mesh(), facemesh=None)
        with pytest.warns(match="cannot be estimated"):
            assert head(mesh) is mesh

    def test_points_of_another_kind(self):
        """A mesh whose first points are not FaceMesh's has no pose: it is returned as it is, with a warning."""
        mesh = face_mesh()
        strange = replace(mesh, vertices=np.roll(mesh.vertices, 100, axis=0))
        with pytest.warns(match="cannot be estimated"):
            assert head(strange) is strange

    def test_a_face_of_one_point(self):
        """There is no pose: the mesh is returned as it is, with a warning."""
        flat = replace(face_mesh(), vertices=np.zeros((468, 3), np.float32))
        with pytest.warns(match="cannot be estimated"):
            assert head(flat) is flat
