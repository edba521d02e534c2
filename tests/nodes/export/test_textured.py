"""A mesh and its texture as one model."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from faces import fitted

from graphface import UsageError
from graphface.nodes.export.textured import textured
from graphface.nodes.io.files import TEXTURED_MESH
from graphface.nodes.texture.unwrap import unwrap


class TestTextured:
    @pytest.mark.parametrize("suffix", [".obj", ".ply", ".glb", ".gltf"])
    def test_comes_back_with_every_vertex(self, tmp_path, suffix):
        """Written and read again, vertices and triangles are those of the mesh."""
        trimesh = pytest.importorskip("trimesh")
        photo, mesh, surface = fitted()
        model = textured(mesh, unwrap(photo, mesh, surface, size=64))
        TEXTURED_MESH.write(model, tmp_path / f"face{suffix}")
        back = trimesh.load(tmp_path / f"face{suffix}", force="mesh", process=False)
        assert len(back.faces) == len(mesh.triangles)
        np.testing.assert_allclose(back.vertices[back.faces], mesh.vertices[mesh.triangles], atol=0.01)

    def test_a_mesh_without_coordinates_is_refused(self):
        """The user is told which geometry has them."""
        photo, mesh, surface = fitted()
        texture = unwrap(photo, mesh, surface, size=8)
        with pytest.raises(UsageError, match=r"geometry\.morphable"):
            textured(replace(mesh, uv=None), texture)
