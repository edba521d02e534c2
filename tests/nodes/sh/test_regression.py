"""Ridge regression of coefficients, and what it does about outliers."""

from __future__ import annotations

import numpy as np
import pytest

from graphface.nodes.sh.regression import CONDITION_CAP, condition_number, ridge_regression, robust_regression


def line(outliers=0):
    """A straight line through 100 points, the first of which are far off: design, values, weights."""
    x = np.linspace(-1, 1, 100)
    values = 0.5 + 0.25 * x
    values[:outliers] += 3
    return np.stack([np.ones_like(x), x], axis=1), values, np.ones(100)


class TestRidgeRegression:
    def test_recovers_the_coefficients(self):
        """With next to no ridge, values that the design explains are explained."""
        np.testing.assert_allclose(ridge_regression(*line(), ridge=1e-9), [0.5, 0.25], atol=1e-6)

    def test_the_constant_has_no_ridge(self):
        """A strong ridge leaves the mean and takes the slope."""
        constant, slope = ridge_regression(*line(), ridge=1e6)
        assert constant == pytest.approx(0.5)
        assert abs(slope) < 1e-5

    def test_weight_zero_is_left_out(self):
        """Values without weight change nothing."""
        design, values, weights = line(outliers=20)
        weights[:20] = 0
        np.testing.assert_allclose(ridge_regression(design, values, weights, 1e-9), [0.5, 0.25], atol=1e-6)


class TestRobustRegression:
    def test_trimmed_ignores_a_tenth(self):
        """Outliers among the share that is left out do not count at all."""
        found = robust_regression(*line(outliers=10), ridge=1e-9, robust="trimmed", keep=0.8)
        np.testing.assert_allclose(found, [0.5, 0.25], atol=1e-6)

    @pytest.mark.parametrize("robust", ["huber", "trimmed"])
    def test_is_nearer_than_least_squares(self, robust):
        """Both are closer to the line than a plain fit."""
        plain, careful = (robust_regression(*line(10), ridge=1e-9, robust=r, keep=0.8) for r in ("none", robust))
        assert np.abs(careful - [0.5, 0.25]).max() < 0.5 * np.abs(plain - [0.5, 0.25]).max()

    def test_channels_share_their_weights(self):
        """A point that is off in one channel is left out in all."""
        design, values, weights = line()
        both = np.stack([values, line(10)[1]], axis=1)
        found = robust_regression(design, both, weights, 1e-9, "trimmed", 0.8)
        np.testing.assert_allclose(found, [[0.5, 0.5], [0.25, 0.25]], atol=1e-6)


class TestConditionNumber:
    def test_of_known_matrices(self):
        """That of the design matrix, the root of the Gram matrix's."""
        assert condition_number(np.diag([100.0, 1.0])) == pytest.approx(10)

    def test_is_capped(self):
        """A singular matrix has a large number, not infinity; so has one of zeros."""
        assert condition_number(np.diag([1.0, 0.0])) == pytest.approx(CONDITION_CAP)
        assert np.isfinite(condition_number(np.zeros((2, 2))))
