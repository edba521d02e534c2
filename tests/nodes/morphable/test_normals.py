"""Normals of a triangle mesh."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from graphface.nodes.morphable.normals import vertex_normals


class TestVertexNormals:
    def test_do_not_depend_on_the_cut_of_a_square(self):
        """A cube corner's normal is the diagonal however its faces are cut into triangles."""
        vertices = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [0, 1, 1]], float)
        cut_one = np.array([[0, 2, 1], [0, 3, 2], [0, 1, 5], [0, 5, 4], [0, 4, 6], [0, 6, 3]], np.int32)
        cut_two = np.array([[0, 3, 1], [1, 3, 2], [0, 1, 4], [1, 5, 4], [0, 4, 3], [4, 6, 3]], np.int32)
        expected = -np.ones(3) / np.sqrt(3)
        for cut in (cut_one, cut_two):
            np.testing.assert_allclose(vertex_normals(vertices, cut)[0], expected, atol=1e-6)

    @given(st.floats(-1e4, 1e4), st.floats(0, 1e-30))
    def test_stay_unit_for_collapsed_triangles(self, place, size):
        """Triangles without area give unit normals, not NaN."""
        vertices = np.array([[place, place, 0], [place + size, place, 0], [place, place + size, 0]])
        normals = vertex_normals(vertices, np.array([[0, 1, 2]], np.int32))
        np.testing.assert_allclose(np.linalg.norm(normals, axis=1), 1, atol=1e-5)
