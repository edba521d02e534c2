"""Kernel density of a photo's pixels."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from graphface.nodes.masks.kernel_density import KernelDensity

DARK, LIGHT = (0.2, 0.05, 0.05), (0.8, -0.1, 0.1)


def two_colors():
    """Twenty pixels of a dark color, then twenty of a light one."""
    return np.repeat(np.float32([DARK, LIGHT]), 20, axis=0).reshape(4, 10, 3)


class TestKernelDensity:
    def test_likely_where_learned(self):
        """With dark pixels as samples dark pixels are likely and light ones are not."""
        found = KernelDensity(two_colors()).log_density(np.repeat(np.float32([1, 0]), 20), pseudo_count=1.0)
        assert found[:20].min() > found[20:].max() + 2

    def test_scale_of_weights(self):
        """Without a pseudo-count only proportions of weights matter."""
        density, weights = KernelDensity(two_colors()), np.linspace(0.1, 1, 40, dtype=np.float32)
        np.testing.assert_allclose(density.log_density(weights), density.log_density(3 * weights), atol=1e-2)

    def test_without_samples(self):
        """Without samples it is the marginal density of the photo."""
        density = KernelDensity(two_colors())
        np.testing.assert_allclose(density.log_density(np.zeros(40, np.float32)), density.log_marginal, atol=1e-4)

    def test_pseudo_count(self):
        """The fewer the samples, the nearer the density comes to the marginal."""
        density, weights = KernelDensity(two_colors()), np.repeat(np.float32([1, 0]), 20)
        away = [
            np.abs(density.log_density(w * weights, pseudo_count=1.0) - density.log_marginal).max()
            for w in (1, 0.1, 0.01)
        ]
        assert away[0] > away[1] > away[2]

    def test_lightness_spread(self):
        """It makes a lighter shade likelier, and another hue not."""
        values = np.float32([[(0.5, 0.2, 0.2)] * 8 + [(0.7, 0.2, 0.2), (0.5, 0.4, 0.2)]])
        weights = np.float32([1] * 8 + [0, 0])
        narrow, wide = (
            KernelDensity(values).log_density(weights, pseudo_count=0.1, lightness_spread=spread)
            for spread in (0.0, 0.1)
        )
        assert wide[8] > narrow[8] + 0.5
        assert wide[9] <= narrow[9] + 0.1

    def test_texture_counts(self):
        """Pixels of one color differ by their texture."""
        values = np.zeros((1, 40, 11), np.float32)
        values[0, 20:, 3:7] = (0.04, 0.04, 0.02, 0.02)
        found = KernelDensity(values).log_density(np.repeat(np.float32([1, 0]), 20), pseudo_count=1.0)
        assert found[:20].min() > found[20:].max() + 2

    @given(
        arrays(
            np.float32,
            st.tuples(st.integers(1, 5), st.integers(1, 5), st.sampled_from([3, 11])),
            elements=st.sampled_from([0.0, 0.5, 1.0, -2.0, np.nan]),
        ),
        st.floats(0, 10),
    )
    def test_always_finite(self, values, pseudo_count):
        """Flat, extreme and broken features have finite log-likelihoods, with samples or without."""
        density = KernelDensity(values)
        count = values.shape[0] * values.shape[1]
        for weights in (np.zeros(count, np.float32), np.ones(count, np.float32), np.eye(count, dtype=np.float32)[0]):
            assert np.isfinite(density.log_density(weights, pseudo_count=pseudo_count)).all()

    @given(st.integers(0, 2**32 - 1))
    def test_noise_counts_in_proportion(self, seed):
        """A tenth of the noise changes the likelihoods by about a tenth, wherever the pixels lie."""
        rng = np.random.default_rng(seed)
        values = rng.uniform(0.2, 0.8, (12, 12, 3)).astype(np.float32)
        weights = rng.uniform(0, 1, 144).astype(np.float32)
        noises = rng.uniform(-1, 1, (8, *values.shape)).astype(np.float32)
        before = KernelDensity(values).log_density(weights, pseudo_count=5.0)
        moved = [
            np.mean(
                [np.abs(KernelDensity(values + s * n).log_density(weights, pseudo_count=5.0) - before) for n in noises]
            )
            for s in (1e-2, 1e-3)
        ]
        assert moved[0] < 0.2
        assert moved[1] == pytest.approx(moved[0] / 10, rel=0.3)
