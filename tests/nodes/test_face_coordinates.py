"""Face coordinates of pixels."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from graphface import UsageError
from graphface.nodes.face_coordinates import face_coordinates, interpolated, mesh_uv


class TestInterpolated:
    def test_interpolates_vertex_values(self, make_face):
        """Positions of the vertices become positions of the pixels, and 0 off the mesh."""
        _, _, mesh, surface = make_face()
        found = interpolated(mesh.vertices, surface, mesh)
        rows, columns = np.nonzero(surface.coverage)
        projected = mesh.camera.project(found[rows, columns])
        np.testing.assert_allclose(projected, np.stack([columns, rows], axis=1), atol=0.01)
        assert not found[surface.coverage == 0].any()


class TestFaceCoordinates:
    def test_on_and_off_the_face(self, make_face):
        """Within [0, 1] on the face, -1 elsewhere."""
        _, _, mesh, surface = make_face()
        found = face_coordinates(surface, mesh)
        assert (found[surface.coverage == 0] == -1).all()
        assert 0 <= found[surface.coverage > 0].min() <= found[surface.coverage > 0].max() <= 1


class TestMeshUv:
    def test_a_mesh_without_texture_coordinates(self, make_face):
        """It is refused, with a geometry that has them."""
        _, _, mesh, _ = make_face()
        with pytest.raises(UsageError, match=r"geometry\.morphable"):
            mesh_uv(replace(mesh, uv=None))
