"""Fewer triangles for a mesh."""

from __future__ import annotations

import numpy as np

from graphface.nodes.learning.decimation import decimated


def sphere(rings=24, sectors=48):
    """A closed sphere of radius 1, counter-clockwise from outside."""
    polar = np.linspace(0, np.pi, rings + 1)[1:-1]
    turn = np.arange(sectors) * 2 * np.pi / sectors
    ring = np.stack(
        [
            np.outer(np.sin(polar), np.cos(turn)),
            np.outer(np.sin(polar), np.sin(turn)),
            np.outer(np.cos(polar), turn**0),
        ],
        2,
    ).reshape(-1, 3)
    points = np.concatenate([ring, [[0, 0, 1], [0, 0, -1]]])
    top, bottom, last = len(ring), len(ring) + 1, len(ring) - sectors
    triangles = []
    for k in range(sectors):
        n = (k + 1) % sectors
        triangles += [(top, k, n), (bottom, last + n, last + k)]
        for row in range(0, last, sectors):
            triangles += [(row + k, row + sectors + k, row + n), (row + n, row + sectors + k, row + sectors + n)]
    return points, np.array(triangles)


class TestDecimated:
    def test_stays_closed_and_near(self):
        """A sphere keeps its shape with a quarter of the triangles, and every edge keeps two of them."""
        points, triangles = sphere()
        kept = decimated(points, triangles, np.ones(len(points)), len(triangles) // 4)
        assert len(kept) <= len(triangles) // 4 + 1
        sides = np.sort(np.concatenate([kept[:, [0, 1]], kept[:, [1, 2]], kept[:, [2, 0]]]), axis=1)
        assert (np.unique(sides, axis=0, return_counts=True)[1] == 2).all()
        middles = points[kept].mean(axis=1)
        assert np.linalg.norm(middles, axis=1).min() > 0.95
        a, b, c = (points[kept[:, k]] for k in range(3))
        assert (np.cross(b - a, c - a) * middles).sum(axis=1).min() > 0

    def test_keeps_detail_where_it_matters(self):
        """The important half of a sphere keeps more triangles."""
        points, triangles = sphere()
        weight = np.where(points[:, 0] > 0, 1.0, 0.01)
        kept = points[decimated(points, triangles, weight, len(triangles) // 4)].mean(axis=1)
        assert (kept[:, 0] > 0).sum() > 1.3 * (kept[:, 0] < 0).sum()

    def test_the_boundary_stays(self):
        """Vertices on the edge of an open surface are not taken away."""
        grid = np.stack(np.meshgrid(np.arange(9.0), np.arange(9.0)), 2).reshape(-1, 2)
        points = np.concatenate([grid, np.zeros((81, 1))], axis=1)
        corner = np.array([r * 9 + c for r in range(8) for c in range(8)])
        triangles = np.concatenate(
            [np.stack([corner, corner + 1, corner + 9], 1), np.stack([corner + 1, corner + 10, corner + 9], 1)]
        )
        kept = np.unique(decimated(points, triangles, np.ones(81), 10))
        edge = np.flatnonzero((grid == 0).any(axis=1) | (grid == 8).any(axis=1))
        assert np.isin(edge, kept).all()
        assert len(kept) < 81
