"""Weights of small networks on disk, of any of them."""

from __future__ import annotations

import json

import numpy as np
import pytest

from graphface import UnreadableFile, UnwritableFile
from graphface.nodes.network_weights import Network, read_network, write_network

TOY = Network("toy-1", "toy network", (2, 3), 4, "toys")


def weights():
    return {
        "across.0.weight": np.full((1, 1, 3, 2), 0.5, np.float32),
        "down.0.0.weight": np.full((3, 3, 4, 2), 0.25, np.float32),
        "down.0.0.bias": np.float32([1 / 3, 2]),
    }


class TestReadNetwork:
    def test_written_weights_come_back(self, tmp_path):
        """As float32, with the card beside them."""
        write_network(weights(), {"license": "none"}, tmp_path / "a.safetensors", TOY)
        found = read_network(tmp_path / "a.safetensors", TOY)
        assert all(values.dtype == np.float32 for values in found.values())
        for name, values in weights().items():
            np.testing.assert_array_equal(found[name], values)
        assert json.loads((tmp_path / "a.json").read_text()) == {"format": "toy-1", "license": "none"}

    @pytest.mark.parametrize(
        ("other", "reason"),
        [
            (Network("toy-2", "toy network", (2, 3), 4, "toys"), "format"),
            (Network("toy-1", "toy network", (2, 5), 4, "toys"), "widths"),
            (Network("toy-1", "toy network", (2, 3), 7, "toys"), "7 input channels"),
        ],
    )
    def test_of_another_network(self, tmp_path, other, reason):
        """Weights of another format, width or input are refused with the reason."""
        write_network(weights(), {}, tmp_path / "a.safetensors", TOY)
        with pytest.raises(UnreadableFile, match=reason):
            read_network(tmp_path / "a.safetensors", other)

    def test_no_file(self, tmp_path):
        """A file that is missing is named."""
        with pytest.raises(UnreadableFile, match="no such file"):
            read_network(tmp_path / "a.safetensors", TOY)


class TestWriteNetwork:
    def test_another_suffix(self, tmp_path):
        """Weights are written as safetensors only."""
        with pytest.raises(UnwritableFile, match="safetensors"):
            write_network(weights(), {}, tmp_path / "a.npz", TOY)
