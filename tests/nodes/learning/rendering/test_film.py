"""Pictures as cameras make them."""

from __future__ import annotations

import numpy as np
import pytest

from graphface.nodes.learning.rendering.film import developed


class TestDeveloped:
    @pytest.mark.parametrize("gain", [1e-4, 1.0, 1e3])
    def test_exposure(self, gain):
        """However much light there is, the face is neither black nor white."""
        ramp = np.linspace(0.2, 1, 48, dtype=np.float32)[:, None, None] * np.ones((48, 48, 3), np.float32)
        for seed in range(10):
            photo = developed(ramp * np.float32(gain), np.ones((48, 48), bool), np.random.default_rng(seed))
            assert photo.dtype == np.uint8
            assert 25 < np.median(photo) < 245

    @pytest.mark.filterwarnings("error")
    @pytest.mark.parametrize("value", [0.0, 1e-9, 1e6])
    def test_flat(self, value):
        """A black or burning picture is one."""
        for seed in range(6):
            photo = developed(
                np.full((16, 16, 3), value, np.float32), np.zeros((16, 16), bool), np.random.default_rng(seed)
            )
            assert photo.shape == (16, 16, 3)
