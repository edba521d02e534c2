"""One shadow map for each light that casts a shadow."""

from __future__ import annotations

import numpy as np
import pytest

from graphface.nodes.render.samples import samples
from graphface.nodes.render.shadow_maps import shadow_maps
from graphface.nodes.surface.rasterize import rasterize
from graphface.nodes.types import (
    Camera,
    Image,
    Mesh,
    Scene,
)

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


def receivers(mesh, photo=PHOTO, resolution=64):
    surface = rasterize(mesh, photo)
    return samples(surface, surface.coverage, surface.coverage, photo, mesh, resolution=resolution)


def visible(mesh, light, resolution=64, **settings):
    return shadow_maps(
        mesh, receivers(mesh, resolution=resolution), Scene.coerce({"lights": [light]}), **settings
    ).visible[0]


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
            seen = visible(mesh, {**LIGHT, "size": 15, "shadow": shadow}, smoothing=0, resolution=200)
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
