"""Values at sample points as maps that can be enlarged."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from graphface.nodes.render.sample_grid import enlarged, on_grid, visible_shares
from graphface.nodes.render.samples import samples
from graphface.nodes.types import (
    Camera,
    Image,
    Mesh,
    Shadows,
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


def samples_of(surface, resolution=20.0):
    return samples(surface, 0.5 * surface.coverage, surface.coverage, PHOTO, MESH, resolution=resolution)


class TestMaps:
    @given(resolution=st.floats(4, 80), radius=st.floats(1, 90), channels=st.sampled_from([(), (3,)]))
    def test_a_constant_stays_one_up_to_the_edge(self, resolution, radius, channels):
        """Enlarged to the picture, nothing of what lies beyond the surface mixes in over it."""
        surface = disc(radius)
        found = samples_of(surface, resolution)
        if not len(found.cells):
            return
        large = enlarged(found, on_grid(found, np.full((len(found.cells), *channels), 0.7, np.float32)))
        y, x = np.nonzero(surface.coverage)
        near = np.hypot(x - (SIDE - 1) / 2, y - (SIDE - 1) / 2) < radius - UNIT / resolution
        np.testing.assert_allclose(large[y[near], x[near]], 0.7, atol=1e-5)


class TestVisibleShares:
    def test_are_read_at_the_points(self):
        """What was put on the grid is found at the points again, by the light's index."""
        found = samples_of(disc())
        values = np.random.default_rng(0).random(len(found.cells), dtype=np.float32)
        shares = visible_shares(found, Shadows((3,), on_grid(found, values)[None]))
        assert list(shares) == [3]
        np.testing.assert_array_equal(shares[3], values)

    def test_of_another_grid(self):
        """Maps on another grid are interpolated."""
        found = samples_of(disc())
        shares = visible_shares(found, Shadows((0,), np.full((1, 7, 9), 0.25, np.float32)))
        np.testing.assert_allclose(shares[0], 0.25)

    def test_without_shadows_there_are_none(self):
        """Every light is fully visible."""
        assert visible_shares(samples_of(disc()), None) == {}
