"""Loop subdivision."""

from __future__ import annotations

import numpy as np
import pytest
from faces import grid_model

from graphface.nodes.morphable.builtin import BUILTIN, builtin_model
from graphface.nodes.morphable.storage import load_model
from graphface.nodes.morphable.subdivide import loop, loop_step


class TestLoop:
    def test_the_builtin_model(self):
        """The built-in mesh is its coarse one, subdivided once."""
        coarse = load_model(BUILTIN, refine=False)
        matrix, triangles = loop(coarse.triangles, len(coarse.mean), 1)
        np.testing.assert_allclose(matrix @ coarse.mean.astype(float), builtin_model().mean, atol=1e-6)
        np.testing.assert_array_equal(triangles, builtin_model().triangles)

    @pytest.mark.parametrize("levels", [0, 1, 2])
    def test_constants_stay(self, levels):
        """The rows of the map sum to 1, so a translated mesh has a translated subdivision."""
        model = grid_model()
        matrix, triangles = loop(model.triangles, len(model.mean), levels)
        np.testing.assert_allclose(matrix @ np.ones(len(model.mean)), 1)
        assert len(triangles) == 4**levels * len(model.triangles)


class TestLoopStep:
    def test_boundary_is_a_cubic_spline(self):
        """Of a single triangle new vertices lie in the middle of its edges, old ones move by a quarter of the way."""
        matrix, triangles = loop_step(np.int32([[0, 1, 2]]), 3)
        corners = np.array([[0.0, 0], [8, 0], [0, 8]])
        found = matrix @ corners
        np.testing.assert_allclose(found[0], [1, 1])
        assert sorted(map(tuple, found[3:].tolist())) == [(0, 4), (4, 0), (4, 4)]
        assert len(triangles) == 4
