"""One rendered picture with its truth, its file, a folder of them."""

from __future__ import annotations

import json
from dataclasses import fields

import numpy as np
import pytest

from graphface import UnreadableFile
from graphface.nodes.learning.rendering.example import (
    BARE_SKIN,
    EYES_AND_TEETH,
    FORMAT,
    REST,
    Example,
    read_example,
    write_example,
)
from graphface.nodes.learning.rendering.folder import example_path, render_folder
from graphface.nodes.learning.rendering.picture import make_example


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
        arrays = {name: np.zeros(1) for name in ("photo", "normals", "depth", "labels", "reaching")}
        np.savez(tmp_path / "b.npz", **arrays, facts=np.array(json.dumps({"format": "other"})))
        with pytest.raises(UnreadableFile, match="format"):
            read_example(tmp_path / "b.npz")


class TestMakeExample:
    def test_a_head(self, head):
        """A tiny picture: a lit face with unit normals, labels and light that reaches it; the same every time."""
        pytest.importorskip("mitsuba", reason="rendering needs mitsuba: pip install 'graphface[truth]'")
        found, again = (make_example(head, 5, size=48, samples=1) for _ in range(2))
        np.testing.assert_array_equal(found.photo, again.photo)
        on = found.labels != REST
        lengths = np.linalg.norm(found.normals[on].astype(float), axis=1)
        assert abs(lengths - 127).max() < 2
        assert (found.labels == BARE_SKIN).mean() > 0.2
        assert (found.labels == EYES_AND_TEETH).any()
        assert found.reaching[on].mean() > 60
        assert found.photo[on].mean() > 20


class TestRenderFolder:
    def test_goes_on_where_it_was(self, shared, tmp_path):
        """What is there is not rendered again."""
        pytest.importorskip("mitsuba", reason="rendering needs mitsuba: pip install 'graphface[truth]'")
        write_example(small(), example_path(tmp_path, 7))
        source = shared / "models" / "ict_facekit.npz"
        assert list(render_folder(source, tmp_path, range(7, 9), size=32, samples=1)) == [(7, False), (8, True)]
        assert read_example(example_path(tmp_path, 8)).photo.shape == (32, 32, 3)
