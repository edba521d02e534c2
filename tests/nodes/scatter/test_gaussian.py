"""One Gaussian for all channels."""

from __future__ import annotations

import pytest

from graphface.nodes.scatter.gaussian import gaussian
from graphface.nodes.types import (
    Scene,
)


class TestGaussian:
    def test_grey_stays_grey(self, case):
        """One channel in, one channel out."""
        assert gaussian(case.step, case.old, case.surface, case.landmarks, case.photo, Scene(scatter=0.05)).ndim == 2

    def test_width(self, case):
        """One standard deviation beside the step the light is at 84 % of it."""
        soft = case.scattered(gaussian, case.step, 0.2)[30, :, 0]
        sigma = int(0.2 * 40)
        assert (soft[40 - sigma] - 0.2) / 0.6 == pytest.approx(0.84, abs=0.03)
        assert (soft[40 + sigma] - 0.2) / 0.6 == pytest.approx(0.16, abs=0.03)
