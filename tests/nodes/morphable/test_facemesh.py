"""FaceMesh's points as a mesh."""

from __future__ import annotations

import numpy as np

from graphface.nodes.morphable.facemesh import facemesh_mesh
from graphface.nodes.morphable.topology import facemesh_topology
from graphface.nodes.types import Landmarks


class TestFacemeshMesh:
    def test_attributes(self):
        """Texture coordinates, mirror pairs and points of every vertex; the origin is the mean point."""
        points = facemesh_topology().mean * (100, -100, 100) + (200, 150, 0)
        mesh = facemesh_mesh(Landmarks(points.astype(np.float32), "facemesh468"))
        np.testing.assert_allclose(mesh.vertices.mean(axis=0), 0, atol=1e-3)
        assert mesh.facemesh.tolist() == list(range(468))
        np.testing.assert_allclose(mesh.vertices[mesh.mirror] * (-1, 1, 1), mesh.vertices, atol=1e-2)
        assert mesh.uv.shape == (468, 2)
