"""Priors over coefficients."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from graphface.nodes.morphable.prior import Mixture, marginal, prepare, quadratic, standard


class TestPrior:
    @given(arrays(np.float64, 3, elements=st.floats(-5, 5)))
    def test_the_quadratic_bounds_the_mixture(self, x):
        """The bound touches at x, and lies above everywhere else: descending it descends the prior."""
        rng = np.random.default_rng(1)
        means, roots = rng.normal(size=(3, 3)), rng.normal(size=(3, 3, 3))
        covariances = roots @ roots.transpose(0, 2, 1) + 0.1 * np.eye(3)
        prior = prepare(Mixture(np.float32([0.2, 0.3, 0.5]), means.astype(np.float32), covariances.astype(np.float32)))
        value, gradient, hessian = quadratic(prior, x)
        for step in rng.normal(size=(20, 3)):
            bound = value + gradient @ step + step @ hessian @ step / 2
            assert quadratic(prior, x + step)[0] <= bound + 1e-6 * (1 + abs(bound))

    def test_gradient_is_the_derivative(self, rng):
        """Central differences of the value agree with the gradient."""
        prior = prepare(
            Mixture(np.float32([0.5, 0.5]), np.float32([[-1, 0], [2, 1]]), np.stack([np.eye(2)] * 2).astype(np.float32))
        )
        x = rng.normal(size=2)
        steps = 1e-5 * np.eye(2)
        differences = [(quadratic(prior, x + s)[0] - quadratic(prior, x - s)[0]) / 2e-5 for s in steps]
        np.testing.assert_allclose(differences, quadratic(prior, x)[1], atol=1e-6)

    def test_the_marginal_of_some_coefficients(self):
        """Leaving coefficients out keeps the means and covariances of the others."""
        kept = marginal(standard(4), np.array([1, 3]))
        assert kept.means.shape == (1, 2)
        np.testing.assert_array_equal(kept.covariances[0], np.eye(2))
