"""Scale-invariant peak signal-to-noise ratio."""

from __future__ import annotations

import numpy as np
import pytest

from graphface.nodes.metrics.si_psnr import si_psnr


class TestScaleInvariantPsnr:
    def test_forgives_a_gain(self, rng):
        """A picture at half exposure is as good as the picture."""
        truth = rng.random((8, 8, 3))
        assert si_psnr(truth / 2, truth) > 100

    def test_black_result_is_finite(self):
        """No gain can help black; the figure is that of black."""
        assert si_psnr(np.zeros((2, 2)), np.ones((2, 2))) == pytest.approx(0)
