"""The permutohedral lattice against the Gaussian it stands for."""

from __future__ import annotations

import numpy as np
import pytest

from graphface.nodes.intrinsic.permutohedral import Lattice


def brute_force(features, values):
    squares = np.square(features[:, None] - features[None]).sum(axis=2)
    kernel = np.exp(-squares / 2)
    return kernel @ values / kernel.sum(axis=1, keepdims=True)


class TestLattice:
    @pytest.mark.parametrize("d", [1, 2, 3, 5])
    def test_is_near_the_gaussian(self, d, rng):
        """Within a tenth of the values' spread of the exact filter (its own kernel is only nearly Gaussian)."""
        features = rng.uniform(0, 3, (800, d))
        values = np.sin(features.sum(axis=1, keepdims=True)).astype(np.float32)
        filtered, exact = Lattice(features).filter(values), brute_force(features, values)
        assert np.abs(filtered - exact).mean() < 0.1 * values.std()

    def test_keeps_constants(self, rng):
        """A mean of equal values is that value."""
        filtered = Lattice(rng.normal(size=(200, 5)) * 20).filter(np.full((200, 2), 0.7, np.float32))
        np.testing.assert_allclose(filtered, 0.7, rtol=1e-4)

    def test_far_points_do_not_mix(self):
        """Points a hundred standard deviations apart keep their own values."""
        filtered = Lattice(np.array([[0.0, 0, 0], [100, 0, 0]])).filter(np.float32([[0], [1]]))
        np.testing.assert_allclose(filtered, [[0], [1]], atol=1e-6)

    def test_one_point(self):
        """The smallest lattice there is."""
        assert Lattice(np.zeros((1, 5))).filter(np.float32([[3]])) == pytest.approx(3)
