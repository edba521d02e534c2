"""Spatial smoothing of labels."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from graphface.nodes.masks.smoothing import mean_field, smoothed

METHODS = ["none", "guided", "mean_field"]


def two_halves(rng):
    """Noisy scores of two labels, and a picture with an edge between them."""
    pixels = np.zeros((20, 20, 3), np.float32)
    pixels[:, 10:] = 1
    scores = rng.normal(0, 1, (20, 20, 2)).astype(np.float32)
    scores[:, :10, 0] += 1
    scores[:, 10:, 1] += 1
    return scores, pixels


class TestSmoothed:
    @pytest.mark.parametrize("method", METHODS)
    @given(st.integers(1, 9), st.integers(1, 9), st.sampled_from([0.0, 1.0, 1e3]), st.sampled_from([0.5, np.nan]))
    def test_partition(self, method, height, width, scale, color):
        """Any size, scores and picture: probabilities that sum to 1."""
        scores = scale * np.random.default_rng(0).normal(size=(height, width, 3)).astype(np.float32)
        found = smoothed(scores, np.full((height, width, 3), color, np.float32), method=method)
        assert found.min() >= 0
        np.testing.assert_allclose(found.sum(axis=2), 1, atol=1e-4)

    @pytest.mark.parametrize("method", METHODS[1:])
    def test_removes_noise_and_keeps_the_edge(self, method, rng):
        """More pixels have the right label than without smoothing, up to the edge of the picture."""
        scores, pixels = two_halves(rng)
        truth = np.repeat([0, 1], 10)[None]
        right = {m: (smoothed(scores, pixels, method=m).argmax(axis=2) == truth).mean() for m in ("none", method)}
        assert right[method] > right["none"] + 0.05


class TestMeanField:
    def test_without_strength(self, rng):
        """Without influence of the neighbors the scores decide alone."""
        scores, pixels = two_halves(rng)
        expected = smoothed(scores, pixels, method="none")
        np.testing.assert_allclose(mean_field(scores, pixels, strength=0), expected, atol=1e-6)
