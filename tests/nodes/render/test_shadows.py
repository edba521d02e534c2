"""Shadows: where they fall, where they must not, and lights that are hard to draw a map for."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from graphface.nodes.render.samples import samples
from graphface.nodes.render.shadow_map import disc, lit_share
from graphface.nodes.render.shadows import shadow_maps
from graphface.nodes.surface.rasterize import rasterize
from graphface.nodes.types import Camera, Image, Mesh, Scene

UNIT = 40.0
PHOTO = Image(np.zeros((120, 120, 3), np.float32))


def square(half, z=0.0, center=(0.0, 0.0)):
    """Two triangles facing the viewer."""
    x, y = center
    corners = [(x - half, y - half, z), (x + half, y - half, z), (x + half, y + half, z), (x - half, y + half, z)]
    return np.array(corners, np.float32), np.array([(0, 1, 2), (0, 2, 3)], np.int32)


def wall_with_plate(height=0.5, half=0.3):
    """A wall of three by three eye distances and a small plate floating before its middle."""
    wall, faces = square(1.4)
    plate, plate_faces = square(half, height)
    return np.concatenate([wall, plate]), np.concatenate([faces, plate_faces + 4])


def mesh_of(vertices, triangles):
    normals = np.broadcast_to(np.float32([0, 0, 1]), vertices.shape).copy()
    return Mesh(vertices * UNIT, triangles, normals, Camera(center=(59.5, 59.5)), UNIT)


def shares(points, places, vertices, triangles, resolution=256, lift=0.02):
    points = np.asarray(points, np.float32)
    normals = np.broadcast_to(np.float32([0, 0, 1]), points.shape)
    return lit_share(
        points, normals, np.asarray(places, np.float32), vertices, triangles, resolution=resolution, lift=lift
    )


def receivers(mesh, photo=PHOTO, detail=64):
    surface = rasterize(mesh, photo)
    return samples(surface, surface.coverage, surface.coverage, photo, mesh, detail=detail)


def visible(mesh, light, detail=64, **settings):
    return shadow_maps(mesh, receivers(mesh, detail=detail), Scene.coerce({"lights": [light]}), **settings).visible[0]


class TestLitShare:
    def test_a_point_behind_the_plate_is_dark(self):
        """The middle of the wall sees no lamp straight above the plate."""
        assert shares([[0, 0, 0]], [[0, 0, 5]], *wall_with_plate())[0] < 1e-3

    def test_the_shadow_falls_where_geometry_says(self):
        """A lamp far to the left at 45 degrees moves the plate's shadow right by its height."""
        points = [[x, 0, 0] for x in (0.0, 0.5, 1.0)]
        lit = shares(points, [[-40, 0, 40]], *wall_with_plate(height=0.5, half=0.2))
        assert lit[0] == pytest.approx(1, abs=1e-3)
        assert lit[1] < 1e-3
        assert lit[2] == pytest.approx(1, abs=1e-3)

    @pytest.mark.parametrize("angle", [0, 30, 60, 80, 88])
    @pytest.mark.parametrize("resolution", [1, 32, 128, 512])
    def test_a_plane_never_shades_itself(self, angle, resolution):
        """No acne: every point of an empty wall is lit, up to grazing light and on coarse maps."""
        grid = np.stack([*np.meshgrid(np.linspace(-1.2, 1.2, 40), np.linspace(-1.2, 1.2, 40))], -1).reshape(-1, 2)
        points = np.concatenate([grid, np.zeros((len(grid), 1))], axis=1)
        place = 40 * np.array([[np.sin(np.radians(angle)), 0.1, np.cos(np.radians(angle))]])
        lit = shares(points, place, *square(1.4), resolution=resolution)
        assert lit.min() > 0.99

    def test_the_shadow_reaches_its_plate(self):
        """No peeling: a plate a tenth above the wall shades the wall right beside the line to its edge."""
        lit = shares([[0.35, 0, 0], [0.12, 0, 0]], [[-40, 0, 40]], *wall_with_plate(height=0.1, half=0.3))
        assert (lit < 0.05).all()

    def test_a_large_light_makes_a_penumbra(self):
        """Under a disc, the share rises gradually across the shadow's edge; under a point it jumps."""
        points = [[x, 0, 0] for x in np.linspace(0.1, 0.9, 41)]
        middle = np.float32([0, 0, 8])
        soft = shares(points, middle + disc(np.float32([0, 0, 1]), 2.0, 32), *wall_with_plate())
        hard = shares(points, middle[None], *wall_with_plate())
        assert ((soft > 0.1) & (soft < 0.9)).sum() > 3 * ((hard > 0.1) & (hard < 0.9)).sum()
        assert np.diff(soft).min() > -0.1

    @settings(max_examples=60, deadline=None)
    @given(
        st.tuples(*[st.floats(-3, 3)] * 3),
        st.sampled_from([1, 2, 16, 64]),
        st.sampled_from([0.0, 0.02]),
    )
    def test_any_place_and_size_of_map(self, place, resolution, lift):
        """In the wall, on the plate, behind both, one texel: between 0 and 1."""
        points = np.random.default_rng(0).uniform(-1, 1, (50, 3))
        lit = shares(points, [place], *wall_with_plate(), resolution=resolution, lift=lift)
        assert np.isfinite(lit).all()
        assert lit.min() >= 0
        assert lit.max() <= 1 + 1e-5


LIGHT = {"type": "directional", "azimuth": -45, "size": 2}


class TestShadowMaps:
    def test_only_casting_lights_have_a_map(self):
        """Spherical-harmonic light, light without shadow, without strength and from behind have none."""
        mesh = mesh_of(*wall_with_plate())
        lights = [
            {"type": "sh", "preset": "left"},
            {**LIGHT, "shadow": "none"},
            {**LIGHT, "intensity": 0},
            {**LIGHT, "azimuth": 180},
            LIGHT,
        ]
        shadows = shadow_maps(mesh, receivers(mesh), Scene.coerce({"lights": lights}))
        assert shadows.lights == (4,)
        assert shadows.visible.shape[0] == 1

    @pytest.mark.parametrize("kind", ["directional", "point", "spot"])
    def test_every_kind_of_light_casts(self, kind):
        """The plate's shadow lies to the right of it for a light from the left."""
        light = {**LIGHT, "type": kind, **({} if kind == "directional" else {"distance": 6})}
        seen = visible(mesh_of(*wall_with_plate()), light, smoothing=0)
        assert seen[60, 60 + int(0.55 * UNIT)] < 0.2
        assert seen[60, 15] > 0.98

    def test_soft_is_softer_than_hard(self):
        """More of the wall lies in half shadow."""
        mesh = mesh_of(*wall_with_plate())
        halves = {}
        for shadow in ("hard", "soft"):
            seen = visible(mesh, {**LIGHT, "size": 15, "shadow": shadow}, smoothing=0, detail=200)
            halves[shadow] = ((seen > 0.1) & (seen < 0.9)).sum()
        assert halves["soft"] > 2 * halves["hard"]

    def test_size_of_the_picture_does_not_matter(self):
        """Twice the pixels, the same share of the wall in shadow."""
        mean = []
        for factor in (1, 2):
            vertices, triangles = wall_with_plate()
            mesh = Mesh(
                vertices * UNIT * factor,
                triangles,
                np.broadcast_to(np.float32([0, 0, 1]), vertices.shape).copy(),
                Camera(center=(60 * factor - 0.5, 60 * factor - 0.5)),
                UNIT * factor,
            )
            photo = Image(np.zeros((120 * factor, 120 * factor, 3), np.float32))
            scene = Scene.coerce({"lights": [LIGHT]})
            mean.append(shadow_maps(mesh, receivers(mesh, photo), scene).visible[0].mean())
        assert mean[0] == pytest.approx(mean[1], rel=0.02)

    def test_triangles_without_area_cast_nothing(self):
        """Points and lines among the triangles change nothing."""
        vertices, triangles = wall_with_plate()
        degenerate = np.concatenate([triangles, np.int32([[0, 0, 0], [0, 1, 1], [4, 5, 4]])])
        one, two = (visible(mesh_of(vertices, t), LIGHT) for t in (triangles, degenerate))
        np.testing.assert_allclose(one, two, atol=1e-6)

    def test_nothing_covered(self):
        """A mesh outside the picture: everything is lit, nothing fails."""
        vertices, triangles = wall_with_plate()
        with pytest.warns(match="covers no pixel"):
            assert (visible(mesh_of(vertices + 100, triangles), LIGHT) == 1).all()
