"""Files of meshes."""

from __future__ import annotations

import sys

import numpy as np
import pytest

from graphface import UnwritableFile, UsageError
from graphface.nodes.io.files import MESHES
from graphface.nodes.io.mesh import write_mesh
from graphface.nodes.types import Camera, Image, Mesh, Texture, TexturedMesh
from graphface.registry import default_registry
from graphface.values.port_types import PortType
from graphface.values.writing import check_output

trimesh = pytest.importorskip("trimesh")
MESH = Mesh(
    np.float32([[0, 0, 0], [4, 0, 0], [0, 4, 1]]),
    np.int32([[0, 1, 2]]),
    np.float32([[0, 0, 1]] * 3),
    Camera(),
    4.0,
    uv=np.float32([[0, 0], [1, 0], [0, 1]]),
)
TEXTURE = Texture(Image(np.full((8, 8, 3), (1, 0.5, 0), np.float32)), np.ones((8, 8), np.float32))


class TestWriteMesh:
    @pytest.mark.parametrize("suffix", MESHES)
    def test_is_read_by_others(self, tmp_path, suffix):
        """trimesh reads vertices and triangles back."""
        write_mesh(MESH, tmp_path / f"a{suffix}")
        back = trimesh.load(tmp_path / f"a{suffix}", force="mesh", process=False)
        np.testing.assert_allclose(back.vertices, MESH.vertices, atol=1e-6)
        np.testing.assert_array_equal(back.faces, MESH.triangles)

    def test_ply_has_a_color_for_each_vertex(self, tmp_path):
        """That of the texture at its place."""
        write_mesh(MESH, tmp_path / "a.ply", TEXTURE)
        colors = trimesh.load(tmp_path / "a.ply", process=False).visual.vertex_colors
        np.testing.assert_array_equal(np.asarray(colors)[:, :3], [[255, 128, 0]] * 3)

    def test_obj_has_its_texture_beside_it(self, tmp_path):
        """Named after the file, so that two meshes in one folder do not share one."""
        write_mesh(MESH, tmp_path / "a.obj", TEXTURE)
        write_mesh(MESH, tmp_path / "b.obj", TEXTURE)
        assert {p.stem.partition("_")[0] for p in tmp_path.iterdir()} == {"a", "b"}
        assert any(p.suffix in (".png", ".jpeg", ".jpg") for p in tmp_path.iterdir())

    def test_another_suffix(self, tmp_path):
        """Is answered with the known ones."""
        with pytest.raises(UnwritableFile, match=r"\.obj"):
            write_mesh(MESH, tmp_path / "a.stl")

    def test_a_missing_package_is_named(self, tmp_path, monkeypatch):
        """Without trimesh the user is told what to install."""
        monkeypatch.setitem(sys.modules, "trimesh", None)
        with pytest.raises(UsageError, match=r"graphface\[models\]"):
            write_mesh(MESH, tmp_path / "face.obj")

    @pytest.mark.parametrize("kind", [Mesh, TexturedMesh])
    def test_it_is_missed_before_anything_runs(self, tmp_path, monkeypatch, kind):
        """Where a mesh is asked for as a file, that is."""
        monkeypatch.setitem(sys.modules, "trimesh", None)
        with pytest.raises(UsageError, match=r"face.obj: .*graphface\[models\]"):
            check_output(tmp_path / "face.obj", PortType((kind,)), default_registry().files)
        check_output(tmp_path / "face.png", PortType((kind,)), default_registry().files)
