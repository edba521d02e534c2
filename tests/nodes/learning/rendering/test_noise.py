"""Random functions in space."""

from __future__ import annotations

import numpy as np

from graphface.nodes.learning.rendering.noise import distance_to_line, noise, ramp


class TestNoise:
    def test_unit_variance_at_every_scale(self, rng):
        """The height does not depend on the scale, the slope does."""
        points = rng.uniform(-10, 10, (4000, 3))
        for scale in (0.5, 3.0):
            spread = np.mean([noise(points, np.random.default_rng(k), scale, 2).std() for k in range(8)])
            assert 0.8 < spread < 1.2
        near = points + np.array([0.05, 0, 0])
        fine, coarse = (
            np.abs(noise(near, np.random.default_rng(1), s) - noise(points, np.random.default_rng(1), s)).mean()
            for s in (0.5, 5.0)
        )
        assert fine > 5 * coarse

    def test_the_same_for_the_same_seed(self, rng):
        """It depends on the generator alone."""
        points = rng.normal(size=(50, 3))
        first, again = (noise(points, np.random.default_rng(4), 1.0) for _ in range(2))
        np.testing.assert_array_equal(first, again)


class TestDistanceToLine:
    def test_beside_and_beyond(self):
        """Beside a segment the distance is across it, beyond its ends to the end."""
        line = np.array([[0.0, 0], [2, 0]])
        np.testing.assert_allclose(distance_to_line(np.array([[1.0, 3], [5, 4]]), line), [3, 5])

    def test_a_line_that_is_a_point(self):
        """Corners that fall together are a point."""
        assert distance_to_line(np.array([[3.0, 4]]), np.zeros((2, 2)))[0] == 5


class TestRamp:
    def test_ends(self):
        """Far away it is 0 or 1, without overflow."""
        np.testing.assert_allclose(ramp(np.array([-1e9, 0, 1e9]), 0.1), [0, 0.5, 1], atol=1e-9)
