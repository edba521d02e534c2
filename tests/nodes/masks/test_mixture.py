"""Gaussian mixtures of weighted samples."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from graphface.nodes.masks.mixture import fit_mixture, with_lightness_spread


class TestFitMixture:
    def test_two_clusters(self, rng):
        """Means, weights and spreads of two clusters are found."""
        samples = np.concatenate([rng.normal(0, 0.1, (300, 2)), rng.normal(3, 0.2, (100, 2))])
        mixture = fit_mixture(samples, components=2, rounds=20)
        order = np.argsort(mixture.means[:, 0])
        np.testing.assert_allclose(mixture.means[order], [[0, 0], [3, 3]], atol=0.05)
        np.testing.assert_allclose(mixture.weights[order], [0.75, 0.25], atol=0.01)
        np.testing.assert_allclose(np.sqrt(mixture.covariances[order][:, 0, 0]), [0.1, 0.2], rtol=0.2)

    def test_weights_are_repetitions(self, rng):
        """A weight of two is the sample twice."""
        samples = rng.normal(size=(60, 2))
        weights = rng.integers(1, 3, 60)
        one = fit_mixture(samples, weights, components=1)
        other = fit_mixture(np.repeat(samples, weights, axis=0), components=1)
        np.testing.assert_allclose(one.means, other.means)
        np.testing.assert_allclose(one.covariances, other.covariances)

    def test_density_integrates_to_one(self, rng):
        """The likelihood is a density."""
        mixture = fit_mixture(rng.normal(0, 0.3, (200, 1)), components=2)
        x = np.linspace(-5, 5, 4001)
        assert np.exp(mixture.log_likelihood(x[:, None])).sum() * (x[1] - x[0]) == pytest.approx(1, abs=1e-3)

    def test_no_samples_no_mixture(self):
        """Without samples there is no mixture."""
        assert fit_mixture(np.zeros((0, 3))) is None
        assert fit_mixture(np.zeros((5, 3)), np.zeros(5)) is None
        assert fit_mixture(np.full((5, 3), np.nan)) is None

    @given(
        arrays(
            np.float32, st.tuples(st.integers(1, 60), st.integers(1, 11)), elements=st.sampled_from([0.0, 0.5, 1.0])
        ),
        st.integers(1, 8),
    )
    def test_rank_one_and_flat(self, samples, components):
        """Repeated, collinear and constant samples: finite likelihoods, and covariances no thinner than the floor."""
        mixture = fit_mixture(samples, components=components, floor=0.02)
        assert np.isfinite(mixture.log_likelihood(samples)).all()
        assert np.linalg.eigvalsh(mixture.covariances).min() >= 0.02**2 * 0.99
        assert mixture.weights.sum() == pytest.approx(1)

    @given(st.integers(0, 2**32 - 1))
    def test_a_little_noise_changes_little(self, seed):
        """Nothing is random: noise far below the floor hardly moves the likelihoods."""
        rng = np.random.default_rng(seed)
        samples = np.concatenate([rng.normal(k, 0.2, (80, 3)) for k in range(3)])
        before = fit_mixture(samples, components=1).log_likelihood(samples)
        after = fit_mixture(samples + rng.normal(0, 1e-4, samples.shape), components=1).log_likelihood(samples)
        assert np.abs(before - after).max() < 0.1

    def test_far_away_is_unlikely_and_finite(self):
        """The likelihood falls without overflow."""
        mixture = fit_mixture(np.zeros((10, 3)), components=1)
        far = mixture.log_likelihood(np.float32([[1e3, 0, 0], [1e6, 0, 0]]))
        assert np.isfinite(far).all()
        assert far[1] < far[0] < 0


class TestWithLightnessSpread:
    def test_first_feature_only(self, rng):
        """The variance of the first feature grows by the square of the spread."""
        mixture = fit_mixture(rng.normal(0, 0.1, (100, 3)), components=1)
        wider = with_lightness_spread(mixture, 0.5)
        added = wider.covariances - mixture.covariances
        np.testing.assert_allclose(added[0], np.diag([0.25, 0, 0]), atol=1e-12)
