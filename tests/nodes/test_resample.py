"""Values of the reference at the input's pixels."""

from __future__ import annotations

import numpy as np

from graphface.nodes.resample import resampled
from graphface.nodes.types import Correspondence


def shifted(size: int, dx: float, dy: float) -> Correspondence:
    y, x = np.mgrid[:size, :size].astype(np.float32)
    ones = np.ones((size, size), np.float32)
    return Correspondence(np.dstack([x + np.float32(dx), y + np.float32(dy)]), ones, ones, (size, size))


class TestResampled:
    def test_whole_pixels_are_exact(self, rng):
        """A shift by whole pixels copies values."""
        values = rng.random((12, 12, 3), np.float32)
        np.testing.assert_allclose(resampled(values, shifted(12, 2, 1))[:10, :10], values[1:11, 2:12], atol=1e-6)

    def test_a_linear_ramp_is_exact_between_pixels(self):
        """Cubic interpolation reproduces a plane."""
        ramp = np.tile(np.arange(16, dtype=np.float32), (16, 1))
        got = resampled(ramp, shifted(16, 0.5, 0))
        np.testing.assert_allclose(got[4:12, 4:12], ramp[4:12, 4:12] + 0.5, atol=1e-2)

    def test_a_larger_reference_is_averaged(self):
        """A checkerboard of single pixels seen at a quarter of its size is grey, not noise."""
        board = (np.indices((128, 128)).sum(axis=0) % 2).astype(np.float32)
        y, x = np.mgrid[:32, :32].astype(np.float32)
        ones = np.ones((32, 32), np.float32)
        seen = resampled(board, Correspondence(np.dstack([4 * x + 1, 4 * y]), ones, ones, (128, 128)))
        np.testing.assert_allclose(seen[4:-4, 4:-4], 0.5, atol=0.05)

    def test_where_the_point_is_hidden_nothing_of_it_is_left(self):
        """However little the mirror image is worth: what lies in front of a hidden point is no part of the face."""
        ramp = np.tile(np.arange(16, dtype=np.float32), (16, 1))
        found = shifted(16, 0, 0)
        hidden, little = np.zeros((16, 16), np.float32), np.full((16, 16), 0.1, np.float32)
        mirrored = np.ascontiguousarray(found.places * (-1, 1) + (15, 0), np.float32)
        got = resampled(ramp, Correspondence(found.places, found.inside, hidden, (16, 16), mirrored, little))
        np.testing.assert_allclose(got, ramp[:, ::-1], atol=1e-3)

    def test_off_the_mesh_nothing_is_computed(self):
        """An empty correspondence gives zeros of the right size."""
        nowhere = np.zeros((6, 5), np.float32)
        found = Correspondence(np.zeros((6, 5, 2), np.float32), nowhere, nowhere, (12, 12))
        np.testing.assert_array_equal(resampled(np.ones((12, 12, 3), np.float32), found), np.zeros((6, 5, 3)))
