"""The head behind the face, light taken from a photo, and highlights."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from graphface.nodes.geometry.facemesh import facemesh
from graphface.nodes.harmonics import ambient, basis
from graphface.nodes.light.scene import scene_of
from graphface.nodes.morphable.topology import facemesh_topology
from graphface.nodes.render.head import head
from graphface.nodes.render.neck import neck, underside
from graphface.nodes.render.samples import samples
from graphface.nodes.render.specular import specular
from graphface.nodes.surface.rasterize import rasterize
from graphface.nodes.types import Image, Landmarks, Lighting, Scene

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

    def test_points_nobody_knows(self):
        """A mesh that does not tell its points comes back, with a warning."""
        mesh = replace(face_mesh(), facemesh=None)
        with pytest.warns(match="no pose"):
            assert head(mesh) is mesh

    def test_points_of_another_kind(self):
        """A mesh whose first points are not FaceMesh's tells no pose: it comes back, with a warning."""
        from dataclasses import replace

        mesh = face_mesh()
        strange = replace(mesh, vertices=np.roll(mesh.vertices, 100, axis=0))
        with pytest.warns(match="no pose"):
            assert head(strange) is strange

    def test_a_face_of_one_point(self):
        """No pose to be had: the mesh comes back, with a warning."""
        from dataclasses import replace

        flat = replace(face_mesh(), vertices=np.zeros((468, 3), np.float32))
        with pytest.warns(match="no pose"):
            assert head(flat) is flat


class TestNeck:
    def test_is_closed_around(self):
        """The seam at its back has one normal, and all look outwards."""
        points, normals, _ = neck(rows=10, sectors=16)
        ring = normals.reshape(11, 17, 3)
        np.testing.assert_allclose(ring[:, 0], ring[:, -1])
        outward = points * (1, 0, 1) - (0, 0, points[:, 2].mean())
        assert (np.einsum("nc,nc->n", outward, normals) > 0).mean() > 0.95

    @settings(max_examples=40, deadline=None)
    @given(st.integers(0, 2**32 - 1), st.floats(0, 10))
    def test_underside_of_any_edge(self, seed, size):
        """However the edge of a jaw runs, vertices are finite and normals of unit length."""
        rng = np.random.default_rng(seed)
        outward = rng.normal(size=(9, 3))
        outward /= np.linalg.norm(outward, axis=1, keepdims=True)
        points, normals, triangles = underside(size * rng.normal(size=(9, 3)), outward)
        assert np.isfinite(points).all()
        np.testing.assert_allclose(np.linalg.norm(normals, axis=1), 1, atol=1e-4)
        assert triangles.max() < len(points)

    def test_underside_begins_at_the_edge(self):
        """Its first row is the face's rim, with the face's normals: there is no crease."""
        edge = np.stack([np.linspace(-0.7, 0.7, 9), -0.9 + np.linspace(-0.7, 0.7, 9) ** 2, np.zeros(9)], axis=1)
        outward = np.tile([0.0, -0.5, np.sqrt(0.75)], (9, 1))
        points, normals, _ = underside(edge, outward)
        np.testing.assert_allclose(points[:9], edge)
        np.testing.assert_allclose(normals[:9], outward)


class TestSceneOf:
    def test_light_from_the_left_is_light_from_the_left(self):
        """The scene's light is brightest where the fitted one is."""
        light = Lighting(np.float32([2, 0, 0.6, -0.8]))
        scene = scene_of(light, PHOTO)
        left, right = np.float32([[-0.7, 0, 0.7]]), np.float32([[0.7, 0, 0.7]])
        values = scene.lights[0].values
        assert basis(left, 2) @ values > 1.5 * (basis(right, 2) @ values)

    def test_even_light_stays_even(self):
        """Ambient in, ambient out, of mean 1."""
        values = scene_of(ambient(0.3), PHOTO).lights[0].values
        normals = np.float32([[0, 0, 1], [1, 0, 0], [0, -0.6, 0.8]])
        np.testing.assert_allclose(basis(normals, 2) @ values, 1, atol=1e-3)

    def test_colored_light_stays_colored(self):
        """One light per channel."""
        light = Lighting(np.repeat(np.float32([[2], [0], [0], [0.5]]), 3, axis=1) * np.float32([1, 0.8, 0.5]))
        assert scene_of(light, PHOTO).colored

    def test_darkness(self):
        """A black reference gives even light, with a warning."""
        with pytest.warns(match="hardly any light"):
            assert scene_of(Lighting(np.zeros(4, np.float32)), PHOTO).ambient == 1


class TestSpecular:
    MESH = face_mesh()
    SURFACE = rasterize(MESH, PHOTO)

    def shine(self, scene):
        estimated = 0.5 * self.SURFACE.coverage
        points = samples(self.SURFACE, estimated, self.SURFACE.coverage, PHOTO, self.MESH)
        return specular(points, scene, self.SURFACE.coverage)

    def test_lies_between_light_and_viewer(self):
        """A light from the left makes its highlight on the left half."""
        scene = Scene.coerce({"specular": 1, "lights": [{"type": "directional", "azimuth": -60}]})
        sums = self.shine(scene)[..., 0].sum(axis=0)
        assert sums[:80].sum() > 1.5 * sums[80:].sum()

    def test_ambient_light_makes_none(self):
        """Nor does spherical-harmonic light."""
        assert not self.shine(
            Scene.coerce({"specular": 1, "ambient": 1, "lights": [{"type": "sh", "preset": "left"}]})
        ).any()

    @settings(max_examples=30, deadline=None)
    @given(st.floats(-180, 180), st.floats(-90, 90), st.floats(0.05, 1), st.sampled_from([0.0, 1.0, 1e6]))
    def test_any_light(self, azimuth, elevation, roughness, intensity):
        """Grazing, behind, a mirror, enormous: finite and not negative."""
        light = {"type": "directional", "azimuth": azimuth, "elevation": elevation, "intensity": intensity}
        shine = self.shine(Scene.coerce({"specular": 1, "roughness": roughness, "lights": [light]}))
        assert np.isfinite(shine).all()
        assert shine.min() >= 0
