"""Meshes written for other programs."""

from __future__ import annotations

import sys

import numpy as np
import pytest
from faces import fitted

from graphface import UnwritableFile, UsageError
from graphface.nodes.io.mesh import write_mesh


class TestWriteMesh:
    @pytest.mark.parametrize("suffix", [".obj", ".ply", ".glb", ".gltf"])
    def test_comes_back_with_every_vertex(self, tmp_path, suffix):
        """Written and read again, vertices and triangles are the same."""
        trimesh = pytest.importorskip("trimesh")
        mesh = fitted()[1]
        write_mesh(mesh, tmp_path / f"face{suffix}")
        back = trimesh.load(tmp_path / f"face{suffix}", force="mesh", process=False)
        assert len(back.faces) == len(mesh.triangles)
        np.testing.assert_allclose(back.vertices[back.faces], mesh.vertices[mesh.triangles], atol=0.01)

    def test_unknown_suffixes_are_refused(self, tmp_path):
        """The error names the suffixes there are."""
        pytest.importorskip("trimesh")
        with pytest.raises(UnwritableFile, match=r"\.glb"):
            write_mesh(fitted()[1], tmp_path / "face.stl")

    def test_a_missing_package_is_named(self, tmp_path, monkeypatch):
        """Without trimesh the user is told what to install."""
        monkeypatch.setitem(sys.modules, "trimesh", None)
        with pytest.raises(UsageError, match=r"graphface\[models\]"):
            write_mesh(fitted()[1], tmp_path / "face.obj")
