"""The small network's arithmetic, against other people's."""

from __future__ import annotations

import json
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.ndimage import correlate

from graphface import UnreadableFile, UnwritableFile
from graphface.nodes.masks.label_network import WIDTHS, convolved, label_scores
from graphface.nodes.masks.label_weights import read_weights, shipped_weights, write_weights
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
        """Four pixels of each cell are told apart."""
        cells = rng.normal(size=(16, 24, CHANNELS)).astype(np.float32)
        scores = label_scores(cells, random_weights)
        assert scores.shape == (32, 48, 3)
        assert not np.allclose(scores[::2, ::2], scores[1::2, ::2])

    def test_pixels_of_a_cell_in_order(self, random_weights):
        """A bias of one of a cell's four outputs shows in its own pixel: right before below."""
        weights = dict(random_weights)
        weights["out.weight"] = np.zeros_like(weights["out.weight"])
        weights["out.bias"] = np.arange(12, dtype=np.float32)
        scores = label_scores(np.zeros((8, 8, CHANNELS), np.float32), weights)
        np.testing.assert_array_equal(scores[:2, :2, 0], [[0, 1], [2, 3]])
        np.testing.assert_array_equal(scores[:2, :2, 2], [[8, 9], [10, 11]])

    def test_the_same_every_time(self, random_weights, rng):
        """Nothing depends on threads or on what was computed before."""
        cells = rng.normal(size=(16, 16, CHANNELS)).astype(np.float32)
        np.testing.assert_array_equal(label_scores(cells, random_weights), label_scores(cells, random_weights))

    def test_the_picture_is_left_alone(self, random_weights, rng):
        """What goes in is not written to."""
        cells = rng.normal(size=(8, 8, CHANNELS)).astype(np.float32)
        cells.setflags(write=False)
        label_scores(cells, random_weights)


class TestWeights:
    def test_shipped(self):
        """The weights that come with the package fit the network, and their card says what taught them."""
        weights = shipped_weights()
        assert label_scores(np.zeros((8, 8, CHANNELS), np.float32), weights).shape == (16, 16, 3)

    def test_there_and_back(self, random_weights, tmp_path):
        """Written weights are read as they were, within half precision."""
        write_weights(random_weights, {"license": "none"}, tmp_path / "a.safetensors")
        found = read_weights(tmp_path / "a.safetensors")
        assert sorted(found) == sorted(random_weights)
        for name, values in found.items():
            np.testing.assert_allclose(values, random_weights[name], rtol=1e-3, atol=1e-4)

    def test_other_files(self, random_weights, tmp_path):
        """What is missing, damaged, or of another network is said."""
        path = tmp_path / "a.safetensors"
        with pytest.raises(UnreadableFile, match="no such file"):
            read_weights(path)
        write_weights({"down.0.0.weight": np.zeros((3, 3, 2, 2))}, {}, path)
        with pytest.raises(UnreadableFile, match="widths"):
            read_weights(path)
        write_weights(random_weights, {}, path)
        path.with_suffix(".json").write_text(json.dumps({"format": "other"}))
        with pytest.raises(UnreadableFile, match="format"):
            read_weights(path)
        path.write_bytes(b"nothing")
        with pytest.raises(UnreadableFile, match="not the weights"):
            read_weights(path)

    def test_another_suffix(self, random_weights, tmp_path):
        """Weights are written as safetensors only."""
        with pytest.raises(UnwritableFile, match="safetensors"):
            write_weights(random_weights, {}, tmp_path / "a.npz")


@pytest.fixture
def random_weights(rng):
    """Weights of the right shapes that mean nothing."""
    shapes = {"out": (1, WIDTHS[0], 12)}
    for level, (before, width) in enumerate(zip((CHANNELS, *WIDTHS[:-1]), WIDTHS, strict=True)):
        shapes |= {f"down.{level}.0": (3, before, width), f"down.{level}.1": (3, width, width)}
    for level, (width, below) in enumerate(pairwise(WIDTHS)):
        shapes |= {f"across.{level}": (1, below, width), f"up.{level}": (3, width, width)}
    weights = {}
    for place, (size, inputs, outputs) in shapes.items():
        kernel = rng.normal(size=(size, size, inputs, outputs)) / np.sqrt(size * size * inputs)
        weights[f"{place}.weight"] = kernel.astype(np.float32)
        weights[f"{place}.bias"] = rng.normal(0, 0.1, outputs).astype(np.float32)
    return weights
