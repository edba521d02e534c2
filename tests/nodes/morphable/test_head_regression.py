"""A head by the points of its face, as the posterior mean of a Gaussian process."""

from __future__ import annotations

import numpy as np
import pytest

from graphface.nodes.morphable.head_model import builtin_head
from graphface.nodes.morphable.head_regression import Prior, head_regression

PRIOR = Prior(deviation=0.04, width=0.15, noise=0.01, depth_noise=0.05, identity=10)


@pytest.fixture(scope="module")
def regression():
    return head_regression(builtin_head(), PRIOR)


def fitted(regression, points):
    found = regression.coefficients(points)
    return regression.surface(*found), regression.fitted_points(*found)


class TestHeadRegression:
    def test_the_mean_face_gives_the_mean_head(self, regression):
        """Without a difference nothing moves."""
        surface, points = fitted(regression, regression.points)
        np.testing.assert_allclose(surface, regression.mean, atol=1e-6)
        np.testing.assert_allclose(points, regression.points, atol=1e-9)

    def test_an_identity_comes_back(self, regression):
        """Points of a person of the model give the whole head of that person, ears and neck too."""
        identity = np.linspace(-1, 1, PRIOR.identity)
        truth = regression.mean + np.tensordot(identity, regression.identity.astype(np.float64), 1)
        surface, _ = fitted(regression, regression.points + np.tensordot(identity, regression.of_points, 1))
        before, after = (np.linalg.norm(v - truth, axis=1).mean() for v in (regression.mean, surface))
        assert after < 0.4 * before

    def test_points_are_followed_across_more_than_in_depth(self, regression):
        """A network's depth is trusted less."""
        moves = []
        for axis in (0, 2):
            step = np.zeros(3)
            step[axis] = 0.02
            bump = np.exp(-np.square(regression.points - regression.points[1]).sum(axis=1) / 0.02)[:, None] * step
            moves.append((fitted(regression, regression.points + bump)[1] - regression.points)[1, axis])
        assert moves[0] > moves[1] > 0

    def test_far_points_stay_finite(self, regression):
        """Whatever the points are."""
        surface, _ = fitted(regression, regression.points + np.random.default_rng(0).normal(size=(468, 3)) * 100)
        assert np.isfinite(surface).all()

    def test_is_computed_once(self):
        """For each prior."""
        assert head_regression(builtin_head(), PRIOR) is head_regression(builtin_head(), PRIOR)
