"""The nearest light that is not negative."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from graphface.nodes.harmonics import basis, sphere_points
from graphface.nodes.sh.nonnegative import DIRECTIONS, nonnegative_coefficients


class TestNonnegativeCoefficients:
    def test_an_admissible_light_is_left_alone(self):
        """To the last bit."""
        light = np.array([2.0, 0.1, 0.2, 0.1])
        np.testing.assert_array_equal(nonnegative_coefficients(light, np.eye(4), 1), light)

    @settings(max_examples=40, deadline=None)
    @given(st.integers(0, 2**32 - 1), st.integers(1, 3), st.sampled_from([(), (3,)]))
    def test_no_direction_is_negative(self, seed, order, channels):
        """At the constrained directions not at all, whatever the fit was and however many channels it has."""
        start = np.random.default_rng(seed).normal(size=((order + 1) ** 2, *channels))
        found = nonnegative_coefficients(start, np.eye(len(start)), order)
        assert found.shape == start.shape
        assert (basis(sphere_points(DIRECTIONS), order) @ found).min() > -1e-4

    def test_is_the_nearest(self):
        """With the identity as metric, first order: no random admissible light is nearer."""
        start, rng = np.array([0.3, 0.0, 1.0, 0.0]), np.random.default_rng(0)
        found = nonnegative_coefficients(start, np.eye(4), 1)
        constraints = basis(sphere_points(DIRECTIONS), 1)
        others = found + rng.normal(scale=0.1, size=(2000, 4))
        others = others[(others @ constraints.T).min(axis=1) >= 0]
        assert len(others) > 10
        assert np.linalg.norm(others - start, axis=1).min() > np.linalg.norm(found - start) - 1e-3
