"""The neck and the underside of the jaw."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from graphface.nodes.render.neck import neck, underside


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
