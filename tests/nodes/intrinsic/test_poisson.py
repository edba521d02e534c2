"""The Poisson solver: exact, whatever the right-hand side."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from graphface.nodes.intrinsic.poisson import divergence, gradient, solve

fields = arrays(np.float32, st.tuples(st.integers(1, 12), st.integers(1, 12)), elements=st.floats(-10, 10, width=32))


class TestSolve:
    @settings(max_examples=50, deadline=None)
    @given(fields)
    def test_integrates_a_gradient(self, field):
        """From the gradient of a field comes the field, less its mean."""
        again = solve(-divergence(*gradient(field)), screen=0)
        np.testing.assert_allclose(again, field - field.mean(), atol=1e-3)

    @settings(max_examples=50, deadline=None)
    @given(fields, st.floats(1e-3, 10), st.floats(0, 100))
    def test_satisfies_its_equation(self, field, screen, stiffness):
        """screen u - stiffness Laplace(u) = f."""
        u = solve(field, screen=screen, stiffness=stiffness)
        left = screen * u - stiffness * divergence(*gradient(u))
        np.testing.assert_allclose(left, field, atol=2e-5 * (screen + 8 * stiffness) * (1 + np.abs(u).max()))


class TestDivergence:
    @settings(max_examples=50, deadline=None)
    @given(fields)
    def test_is_minus_the_adjoint(self, field):
        """<grad u, grad u> = -<u, div grad u>."""
        down, across = gradient(field)
        energy = float((down * down + across * across).sum(dtype=np.float64))
        inner = -float((field * divergence(down, across)).sum(dtype=np.float64))
        assert abs(energy - inner) <= 1e-3 * (1 + energy)
