"""Multi-scale structural similarity."""

from __future__ import annotations

import numpy as np
import pytest

from graphface.nodes.metrics.ms_ssim import ms_ssim
from graphface.nodes.metrics.ssim import ssim


class TestMsSsim:
    def test_a_small_picture_has_one_scale(self, rng):
        """Then it is SSIM."""
        one, other = rng.random((2, 20, 20)).astype(np.float32)
        assert ms_ssim(one, other) == pytest.approx(max(ssim(one, other), 0), abs=1e-9)

    def test_fine_noise_counts_less_than_in_ssim(self, rng):
        """Coarse scales do not see it."""
        truth = np.repeat(np.repeat(rng.random((20, 20)), 10, 0), 10, 1).astype(np.float32)
        noisy = truth + 0.2 * rng.normal(size=truth.shape).astype(np.float32)
        assert ms_ssim(noisy, truth) > ssim(noisy, truth)
