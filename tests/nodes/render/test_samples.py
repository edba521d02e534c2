"""The points of a surface on a grid."""

from __future__ import annotations

import numpy as np
import pytest

from graphface.nodes.color import decode_srgb
from graphface.nodes.render.sample_grid import enlarged, on_grid
from graphface.nodes.render.samples import samples
from graphface.nodes.types import (
    Camera,
    Image,
    Mesh,
    Surface,
)

SIDE, UNIT = 120, 40.0


PHOTO = Image(np.full((SIDE, SIDE, 3), 0.5, np.float32))


MESH = Mesh(
    np.zeros((3, 3), np.float32),
    np.int32([[0, 1, 2]]),
    np.float32([[0, 0, 1]] * 3),
    Camera(center=(SIDE / 2 - 0.5, SIDE / 2 - 0.5)),
    UNIT,
)


def disc(radius=30.0, side=SIDE):
    """A flat disc that faces the viewer."""
    y, x = np.mgrid[:side, :side] - (side - 1) / 2
    coverage = (np.hypot(x, y) <= radius).astype(np.float32)
    normals = coverage[..., None] * np.float32([0, 0, 1])
    return Surface(normals, coverage * 2, coverage, np.where(coverage > 0, 0, -1).astype(np.int32), normals)


def taken(surface, resolution=20.0, mesh=MESH, photo=PHOTO, estimated=None):
    estimated = 0.5 * surface.coverage if estimated is None else estimated
    return samples(surface, estimated, surface.coverage, photo, mesh, resolution=resolution)


class TestSamples:
    def test_as_many_as_asked_for(self):
        """`resolution` squared points for a square of one inter-ocular distance."""
        surface = disc()
        count = surface.coverage.sum() / UNIT**2 * 20**2
        assert len(taken(surface).cells) == pytest.approx(count, rel=0.05)

    def test_never_finer_than_the_picture(self):
        """A small face has a point for each of its pixels."""
        surface = disc()
        assert len(taken(surface, resolution=4096).cells) == surface.coverage.sum()

    def test_points_are_where_the_camera_sees_them(self):
        """In inter-ocular distances, y upwards, z from the surface."""
        points = taken(disc(), resolution=UNIT).points
        np.testing.assert_allclose(points[:, :2].mean(axis=0), 0, atol=1e-5)
        np.testing.assert_allclose(points[:, 2], 2 / UNIT)
        assert points[0, 1] == pytest.approx(29.5 / UNIT)  # the first row is the topmost

    def test_without_a_mesh_every_pixel_is_one_and_lies_in_the_middle(self):
        """The size and the place of the face are not known."""
        found = taken(disc(), mesh=None)
        assert found.grid == found.picture
        assert not found.points.any()

    @pytest.mark.parametrize("encoding", ["srgb", "linear"])
    def test_irradiance_is_linear_and_not_negative(self, encoding):
        """Whatever the photo's encoding; a fitted shading may be negative."""
        surface = disc()
        estimated = surface.coverage * np.linspace(-0.5, 1, SIDE, dtype=np.float32)
        found = taken(surface, photo=Image(PHOTO.pixels, encoding=encoding), estimated=estimated)
        linear = decode_srgb(found.before) if encoding == "srgb" else found.before
        np.testing.assert_allclose(found.irradiance, np.maximum(linear, 0))

    def test_no_surface(self):
        """No points; maps are empty."""
        found = taken(disc(radius=0))
        assert len(found.cells) == 0
        assert not enlarged(found, on_grid(found, np.zeros(0, np.float32))).any()
