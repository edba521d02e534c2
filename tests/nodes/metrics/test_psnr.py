"""Peak signal-to-noise ratio."""

from __future__ import annotations

import numpy as np
import pytest

from graphface.nodes.metrics.psnr import psnr


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
