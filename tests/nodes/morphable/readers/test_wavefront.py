"""Meshes in Wavefront's OBJ format."""

from __future__ import annotations

import pytest

from graphface import UnreadableFile
from graphface.nodes.morphable.readers.wavefront import read_obj

TEXT = """# a square and a triangle
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
vt 0.5 0.25
vt 0 1
f 1/1 2/1/7 3/2 4/1
f 1//3 2 3
"""


class TestReadObj:
    def test_vertices_texture_and_polygons(self, tmp_path):
        """Polygons of four corners; a triangle repeats its last. Texture coordinates are by vertex."""
        (tmp_path / "a.obj").write_text(TEXT)
        vertices, uv, polygons = read_obj(tmp_path / "a.obj")
        assert vertices.shape == (4, 3)
        assert uv.tolist() == [[0.5, 0.25], [0.5, 0.25], [0, 1], [0.5, 0.25]]
        assert polygons.tolist() == [[0, 1, 2, 3], [0, 1, 2, 2]]

    def test_without_texture(self, tmp_path):
        """Where a vertex has no texture coordinate, there are none."""
        (tmp_path / "a.obj").write_text(TEXT.replace("4/1", "4"))
        assert read_obj(tmp_path / "a.obj")[1] is None

    @pytest.mark.parametrize("text", ["v 0 zero 0", "f one 2 3"])
    def test_damaged(self, tmp_path, text):
        """Numbers that are none are refused with the file."""
        (tmp_path / "a.obj").write_text(text)
        with pytest.raises(UnreadableFile, match=r"a\.obj"):
            read_obj(tmp_path / "a.obj")
