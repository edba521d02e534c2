"""The visible share of a light: where shadows fall, and where they must not."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from graphface.nodes.render.depth_buffer import disc, visible_share


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


def shares(points, places, vertices, triangles, resolution=256, bias=0.02):
    points = np.asarray(points, np.float32)
    normals = np.broadcast_to(np.float32([0, 0, 1]), points.shape)
    return visible_share(
        points, normals, np.asarray(places, np.float32), vertices, triangles, resolution=resolution, bias=bias
    )


class TestVisibleShare:
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
    def test_any_place_and_size_of_map(self, place, resolution, bias):
        """In the wall, on the plate, behind both, one texel: between 0 and 1."""
        points = np.random.default_rng(0).uniform(-1, 1, (50, 3))
        lit = shares(points, [place], *wall_with_plate(), resolution=resolution, bias=bias)
        assert np.isfinite(lit).all()
        assert lit.min() >= 0
        assert lit.max() <= 1 + 1e-5


class TestDisc:
    @pytest.mark.parametrize("towards", [(0, 0, 1), (0, 1, 0), (0.6, 0, -0.8)])
    def test_lies_across_the_direction(self, towards):
        """Within the radius, at right angles to the direction, around its middle."""
        offsets = disc(np.float32(towards), 2.0, 64)
        np.testing.assert_allclose(offsets @ np.float32(towards), 0, atol=1e-5)
        assert np.linalg.norm(offsets, axis=1).max() <= 2.0
        np.testing.assert_allclose(offsets.mean(axis=0), 0, atol=0.1)

    def test_one_point_is_the_middle(self):
        """So a hard light is where it should be."""
        assert not disc(np.float32([0, 0, 1]), 2.0, 1).any()
