"""The file of one rendered picture with its truth."""

from __future__ import annotations

import json
from dataclasses import fields

import numpy as np
import pytest

from graphface import UnreadableFile
from graphface.nodes.learning.rendering.example import FORMAT, Example, read_example, write_example


def small():
    maps = np.zeros((4, 4), np.uint8)
    photo, normals = np.zeros((4, 4, 3), np.uint8), np.zeros((4, 4, 3), np.int8)
    return Example(photo, normals, maps.astype(np.float16), maps, maps, {"format": FORMAT, "seed": 3})


class TestFiles:
    def test_written_and_read(self, tmp_path):
        """An example comes back as it was."""
        write_example(small(), tmp_path / "a.npz")
        found = read_example(tmp_path / "a.npz")
        assert found.facts == {"format": FORMAT, "seed": 3}
        for field in fields(Example)[:-1]:
            np.testing.assert_array_equal(getattr(found, field.name), getattr(small(), field.name))
        assert [path.name for path in tmp_path.iterdir()] == ["a.npz"]

    def test_other_files(self, tmp_path):
        """What is no example is refused."""
        np.savez(tmp_path / "a.npz", photo=np.zeros(3))
        with pytest.raises(UnreadableFile, match="not an example"):
            read_example(tmp_path / "a.npz")
        arrays = {name: np.zeros(1) for name in ("photo", "normals", "depth", "labels", "visibility")}
        np.savez(tmp_path / "b.npz", **arrays, facts=np.array(json.dumps({"format": "other"})))
        with pytest.raises(UnreadableFile, match="format"):
            read_example(tmp_path / "b.npz")
