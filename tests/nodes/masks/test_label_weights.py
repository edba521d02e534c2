"""Weights of the label network on disk."""

from __future__ import annotations

import json

import numpy as np
import pytest
from portraits import portrait

from graphface import UnreadableFile, UnwritableFile
from graphface.nodes.masks.cue import cue
from graphface.nodes.masks.label_network import label_scores
from graphface.nodes.masks.label_weights import LabelWeights, read_weights, shipped_weights, write_weights
from graphface.nodes.masks.network_input import CHANNELS


class TestShippedWeights:
    def test_fit_the_network(self):
        """The weights that come with the package have the network's shapes."""
        weights = shipped_weights()
        assert label_scores(np.zeros((8, 8, CHANNELS), np.float32), weights).shape == (16, 16, 3)


class TestReadWeights:
    def test_written_weights_come_back(self, random_weights, tmp_path):
        """Written weights are read as they were, within half precision."""
        write_weights(random_weights, {"license": "none"}, tmp_path / "a.safetensors")
        found = read_weights(tmp_path / "a.safetensors")
        assert sorted(found) == sorted(random_weights)
        for name, values in found.items():
            np.testing.assert_allclose(values, random_weights[name], rtol=1e-3, atol=1e-4)

    def test_other_files(self, random_weights, tmp_path):
        """Files that are missing, damaged, or of another network are refused with the reason."""
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


class TestWriteWeights:
    def test_another_suffix(self, random_weights, tmp_path):
        """Weights are written as safetensors only."""
        with pytest.raises(UnwritableFile, match="safetensors"):
            write_weights(random_weights, {}, tmp_path / "a.npz")


class TestLabelWeights:
    def test_from_a_file(self, tmp_path):
        """The shipped weights from a file of the user's give the shipped labels."""
        photo, landmarks, _ = portrait()
        write_weights(shipped_weights(), {}, tmp_path / "mine.safetensors")
        found = cue(photo, landmarks, LabelWeights(read_weights(tmp_path / "mine.safetensors")))
        np.testing.assert_array_equal(found.face, cue(photo, landmarks).face)
