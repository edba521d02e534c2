"""The arithmetic of the label network, against SciPy's."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.ndimage import correlate

from graphface.nodes.masks.label_network import convolved, label_scores
from graphface.nodes.masks.network_input import CHANNELS


class TestConvolved:
    @settings(max_examples=40)
    @given(
        st.integers(1, 9),
        st.integers(1, 9),
        st.integers(1, 4),
        st.integers(1, 4),
        st.sampled_from([1, 3, 5]),
        st.integers(0, 99),
    )
    def test_like_scipy(self, height, width, inputs, outputs, size, seed):
        """Each output is the sum of its inputs' correlations with zeros beyond the picture, plus its bias."""
        rng = np.random.default_rng(seed)
        cells = rng.normal(size=(height, width, inputs)).astype(np.float32)
        kernel = rng.normal(size=(size, size, inputs, outputs)).astype(np.float32)
        bias = rng.normal(size=outputs).astype(np.float32)
        found = convolved(cells, {"it.weight": kernel, "it.bias": bias}, "it")
        for k in range(outputs):
            expected = bias[k] + sum(
                correlate(cells[..., c], kernel[..., c, k], mode="constant") for c in range(inputs)
            )
            np.testing.assert_allclose(found[..., k], expected, atol=1e-4)

    def test_rows_in_parts(self, rng):
        """A picture of which only parts go into one product is convolved like its parts."""
        cells = rng.normal(size=(64, 64, 16)).astype(np.float32)
        weights = {
            "it.weight": rng.normal(size=(3, 3, 16, 32)).astype(np.float32),
            "it.bias": np.zeros(32, np.float32),
        }
        whole, part = convolved(cells, weights, "it"), convolved(cells[10:20], weights, "it")
        np.testing.assert_allclose(whole[11:19], part[1:9], atol=1e-4)


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
