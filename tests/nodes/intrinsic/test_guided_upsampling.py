"""Reduced copies, and maps upsampled along the edges of a guide."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from graphface.nodes.intrinsic.guided_upsampling import reduced, upsampled


class TestReduced:
    @given(st.integers(1, 60), st.integers(1, 60), st.integers(1, 80))
    def test_size(self, height, width, longest):
        """The longer side is at most `longest`; what is small enough is the same object."""
        values = np.ones((height, width), np.float32)
        small = reduced(values, longest)
        assert max(small.shape) <= max(longest, 1)
        np.testing.assert_allclose(small, 1, rtol=1e-6)
        assert (small is values) == (longest >= max(height, width))


class TestUpsampled:
    def test_follows_the_edge_of_the_guide(self):
        """A step that the small map shares with the guide is sharp at full size."""
        full = np.zeros((64, 64), np.float32)
        full[:, 29:] = 1
        guide = reduced(full, 16)
        result = upsampled(2 * guide, guide, full)
        np.testing.assert_allclose(result[:, :26], 0, atol=0.05)
        np.testing.assert_allclose(result[:, 32:], 2, atol=0.05)
        assert np.abs(np.diff(result, axis=1)).max() > 1.5

    def test_ignores_what_only_the_guide_has(self, rng):
        """A flat map stays flat whatever the guide does."""
        full = rng.random((40, 40)).astype(np.float32)
        guide = reduced(full, 10)
        np.testing.assert_allclose(upsampled(np.full_like(guide, 0.3), guide, full), 0.3, atol=1e-4)
