"""Means over blocks, and the nearest pixel of a mask."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from graphface.nodes.render.nearest_face import block_means, face_core, nearest_pixel


class TestBlockMeans:
    @given(st.integers(1, 20), st.integers(1, 20), st.integers(1, 7))
    def test_keeps_the_sum(self, height, width, side):
        """Beyond the picture there is nothing: means times the blocks' area add up to the picture."""
        values = np.random.default_rng(0).random((height, width), dtype=np.float32)
        means = block_means(values, side)
        assert means.shape == (-(-height // side), -(-width // side))
        assert means.sum() * side**2 == pytest.approx(values.sum(), rel=1e-4)


class TestFaceCore:
    def test_of_a_soft_mask(self):
        """Half or more; of a faint mask its maximum; of an empty one nothing."""
        np.testing.assert_array_equal(face_core(np.float32([[0, 0.4, 0.5, 1]])), [[False, False, True, True]])
        np.testing.assert_array_equal(face_core(np.float32([[0, 0.1, 0.2]])), [[False, False, True]])
        assert face_core(np.zeros((2, 2), np.float32)) is None


class TestNearestPixel:
    @given(st.integers(1, 12), st.integers(1, 12), st.integers(0, 2**32 - 1))
    def test_against_all_pixels(self, height, width, seed):
        """Pixels of the core are their own nearest; for others the distance is right within a pixel."""
        rng = np.random.default_rng(seed)
        core = rng.random((height, width)) < 0.2
        core.flat[rng.integers(core.size)] = True
        index, distance = nearest_pixel(core)
        places = np.argwhere(core)
        for y, x in np.ndindex(core.shape):
            exact = np.hypot(*(places - (y, x)).T).min()
            row, column = divmod(index[y, x], width)
            assert core[row, column]
            assert np.hypot(row - y, column - x) <= exact + 1
            assert distance[y, x] == pytest.approx(exact, abs=0.1 * exact + 1e-6)
