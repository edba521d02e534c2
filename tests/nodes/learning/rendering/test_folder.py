"""A folder of rendered examples."""

from __future__ import annotations

import numpy as np
import pytest

from graphface.nodes.learning.rendering.example import FORMAT, Example, read_example, write_example
from graphface.nodes.learning.rendering.folder import example_path, photo_path, render_folder, render_people


def small():
    maps = np.zeros((4, 4), np.uint8)
    photo, normals = np.zeros((4, 4, 3), np.uint8), np.zeros((4, 4, 3), np.int8)
    return Example(photo, normals, maps.astype(np.float16), maps, maps, {"format": FORMAT, "seed": 3})


class TestRenderFolder:
    def test_goes_on_where_it_was(self, shared, tmp_path):
        """What is there is not rendered again."""
        pytest.importorskip("mitsuba", reason="rendering needs mitsuba: pip install 'graphface[truth]'")
        write_example(small(), example_path(tmp_path, 7))
        source = shared / "models" / "ict_facekit.npz"
        assert list(render_folder(source, tmp_path, range(7, 9), size=32, samples=1)) == [(7, False), (8, True)]
        assert read_example(example_path(tmp_path, 8)).photo.shape == (32, 32, 3)


class TestRenderPeople:
    def test_goes_on_where_it_was(self, shared, tmp_path):
        """Only what is missing is rendered, under names that tell people apart."""
        pytest.importorskip("mitsuba", reason="rendering needs mitsuba: pip install 'graphface[truth]'")
        source = shared / "models" / "ict_facekit.npz"
        photo_path(tmp_path, 7, 0).write_bytes(b"there")
        made = list(render_people(source, tmp_path, range(7, 8), expressions=2, size=32, samples=1))
        assert made == [(7, 1)]
        assert sorted(path.name for path in tmp_path.iterdir()) == ["0000007_00.png", "0000007_01.png"]
        assert photo_path(tmp_path, 7, 0).read_bytes() == b"there"
