"""Geodesic distances on the pixel grid."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from graphface.nodes.masks.geodesic import geodesic_distance


def start_at(shape, *seeds):
    start = np.full(shape, 1e3, np.float32)
    for seed in seeds:
        start[seed] = 0
    return start


class TestGeodesicDistance:
    def test_of_constant_cost(self):
        """On a constant cost it is the chessboard distance times the cost."""
        y, x = np.mgrid[:9, :9]
        found = geodesic_distance(start_at((9, 9), (2, 3)), np.full((9, 9), 0.5, np.float32), steps=20)
        np.testing.assert_allclose(found, 0.5 * np.maximum(abs(y - 2), abs(x - 3)))

    def test_goes_around_a_wall(self):
        """The path through the gap is cheaper than the one across the wall."""
        cost = np.full((9, 9), 0.1, np.float32)
        cost[:8, 4] = 50
        found = geodesic_distance(start_at((9, 9), (0, 0)), cost, steps=40)
        assert found[0, 8] < 2

    def test_steps_limit_the_path(self):
        """Pixels further than the longest path keep their start value."""
        found = geodesic_distance(start_at((1, 9), (0, 0)), np.ones((1, 9), np.float32), steps=4)
        assert found[0].tolist() == [0, 1, 2, 3, 4, 1e3, 1e3, 1e3, 1e3]

    @given(st.integers(0, 99), st.floats(0, 0.1))
    def test_changes_little_with_noise(self, seed, noise):
        """Distances change by no more than the noise of the cost times the length of the path."""
        rng = np.random.default_rng(seed)
        cost = rng.uniform(0.1, 1, (7, 7)).astype(np.float32)
        noisy = cost + np.float32(noise) * rng.uniform(0, 1, (7, 7)).astype(np.float32)
        before, after = (geodesic_distance(start_at((7, 7), (3, 3)), c, steps=60) for c in (cost, noisy))
        assert np.abs(after - before).max() <= 49 * noise + 1e-4
