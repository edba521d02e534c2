"""Structural dissimilarity."""

from __future__ import annotations

import numpy as np
import pytest

from graphface.nodes.metrics.dssim import dssim
from graphface.nodes.metrics.ssim import ssim


class TestDssim:
    def test_is_half_of_what_similarity_lacks(self, rng):
        """0 for the truth, otherwise (1 - SSIM) / 2."""
        one, other = rng.random((2, 30, 30)).astype(np.float32)
        assert dssim(one, one) == pytest.approx(0, abs=1e-9)
        assert dssim(one, other) == pytest.approx((1 - ssim(one, other)) / 2)
