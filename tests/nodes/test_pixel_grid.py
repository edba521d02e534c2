"""Points at pixels, and grids of pixels."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from graphface.nodes.pixel_grid import grid_middles, lifted_pixels
from graphface.nodes.types import Camera


class TestLiftedPixels:
    @pytest.mark.parametrize("nearness", [0.0, 1 / 300])
    def test_inverts_the_projection(self, nearness, rng):
        """Projecting the points gives the pixels."""
        camera = Camera(1.5, (40.0, 30.0), nearness)
        u, v = rng.integers(0, 80, (2, 20))
        points = lifted_pixels(u, v, rng.uniform(-20, 20, 20).astype(np.float32), camera)
        np.testing.assert_allclose(camera.project(points), np.stack([u, v], axis=1), atol=1e-3)


class TestGridMiddles:
    @given(st.integers(1, 500), st.floats(1e-3, 2))
    def test_increasing_and_inside(self, length, scale):
        """Pixels of the picture in increasing order, at least one, about `scale` times as many."""
        found = grid_middles(length, scale)
        assert 1 <= len(found) <= length
        assert 0 <= found[0] <= found[-1] < length
        assert (np.diff(found) > 0).all()
        assert abs(len(found) - min(1, scale) * length) <= 1
