"""Figures for comparing pictures and normals."""

from __future__ import annotations

import numpy as np
import pytest

from graphface.nodes.metrics.geometry import mean_angle
from graphface.nodes.metrics.pictures import psnr, si_psnr


class TestPsnr:
    def test_known_error(self):
        """A constant error of 0.1 is 20 dB."""
        assert psnr(np.full((4, 4, 3), 0.5), np.full((4, 4, 3), 0.6)) == pytest.approx(20)

    def test_identical_is_capped(self):
        """No error is 120 dB, not infinity."""
        assert psnr(np.ones((2, 2)), np.ones((2, 2))) == pytest.approx(120)

    def test_mask_chooses_the_pixels(self):
        """Errors off the mask do not count."""
        truth, mask = np.zeros((2, 2, 3)), np.float32([[1, 0], [0, 0]])
        result = np.ones((2, 2, 3)) * [[[0.1], [9]], [[9], [9]]]
        assert psnr(result, truth, mask) == pytest.approx(20)


class TestScaleInvariantPsnr:
    def test_forgives_a_gain(self, rng):
        """A picture at half exposure is as good as the picture."""
        truth = rng.random((8, 8, 3))
        assert si_psnr(truth / 2, truth) > 100

    def test_black_result_is_finite(self):
        """No gain can help black; the figure is that of black."""
        assert si_psnr(np.zeros((2, 2)), np.ones((2, 2))) == pytest.approx(0)


class TestMeanAngle:
    def test_right_angle(self):
        """x against y is 90 degrees, whatever the lengths."""
        x, y = np.zeros((3, 3, 3)), np.zeros((3, 3, 3))
        x[..., 0], y[..., 1] = 2, 1
        assert mean_angle(x, y) == pytest.approx(90)

    def test_nothing_in_common_is_an_error(self):
        """Two maps that never meet cannot be compared."""
        with pytest.raises(ValueError, match="no pixel in common"):
            mean_angle(np.zeros((2, 2, 3)), np.ones((2, 2, 3)))
