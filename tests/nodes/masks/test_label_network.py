"""The label network: what its outputs mean."""

from __future__ import annotations

import numpy as np

from graphface.nodes.masks.label_network import label_scores
from graphface.nodes.masks.network_input import CHANNELS


class TestLabelScores:
    def test_twice_the_cells(self, random_weights, rng):
        """The four pixels of a cell have scores of their own."""
        cells = rng.normal(size=(16, 24, CHANNELS)).astype(np.float32)
        scores = label_scores(cells, random_weights)
        assert scores.shape == (32, 48, 3)
        assert not np.allclose(scores[::2, ::2], scores[1::2, ::2])

    def test_pixels_of_a_cell_in_order(self, random_weights):
        """The four outputs of a cell are its pixels row by row."""
        weights = dict(random_weights)
        weights["out.weight"] = np.zeros_like(weights["out.weight"])
        weights["out.bias"] = np.arange(12, dtype=np.float32)
        scores = label_scores(np.zeros((8, 8, CHANNELS), np.float32), weights)
        np.testing.assert_array_equal(scores[:2, :2, 0], [[0, 1], [2, 3]])
        np.testing.assert_array_equal(scores[:2, :2, 2], [[8, 9], [10, 11]])

    def test_the_same_every_time(self, random_weights, rng):
        """Neither threads nor earlier calls change the result."""
        cells = rng.normal(size=(16, 16, CHANNELS)).astype(np.float32)
        np.testing.assert_array_equal(label_scores(cells, random_weights), label_scores(cells, random_weights))

    def test_the_input_is_not_changed(self, random_weights, rng):
        """The input may be read-only."""
        cells = rng.normal(size=(8, 8, CHANNELS)).astype(np.float32)
        cells.setflags(write=False)
        label_scores(cells, random_weights)
