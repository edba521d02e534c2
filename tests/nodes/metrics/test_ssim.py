"""Structural similarity."""

from __future__ import annotations

import numpy as np
import pytest

from graphface.nodes.metrics.ssim import ssim


class TestSsim:
    def test_against_another_implementation(self, rng):
        """scikit-image's, with the Gaussian window of the paper, away from the border."""
        metrics = pytest.importorskip("skimage.metrics")
        truth = rng.random((80, 90)).astype(np.float32)
        result = np.clip(truth + 0.1 * rng.normal(size=truth.shape), 0, 1).astype(np.float32)
        mask = np.zeros(truth.shape, np.float32)
        mask[20:-20, 20:-20] = 1
        window = {"gaussian_weights": True, "sigma": 1.5, "use_sample_covariance": False}
        _, exact = metrics.structural_similarity(result, truth, data_range=1, full=True, **window)
        assert ssim(result, truth, mask) == pytest.approx(exact[mask > 0].mean(), abs=2e-3)
