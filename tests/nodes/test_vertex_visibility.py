"""Which vertices of a mesh the camera sees."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from faces import fitted

from graphface.nodes.types import Mesh
from graphface.nodes.vertex_visibility import facing_camera, unoccluded, vertex_pixels


class TestVertexPixels:
    def test_the_nearest_pixel(self):
        """Row and column are those of the projected vertex, rounded."""
        _, mesh, surface = fitted(20)
        row, column, inside = vertex_pixels(mesh, surface.coverage.shape)
        assert inside.all()
        np.testing.assert_array_equal(np.stack([column, row], axis=1), np.rint(mesh.camera.project(mesh.vertices)))

    def test_beyond_the_frame(self):
        """A vertex outside of the picture gets the pixel at its border, and is marked as outside."""
        _, mesh, surface = fitted(center=(0.0, 150.0))
        _, column, inside = vertex_pixels(mesh, surface.coverage.shape)
        assert (column[~inside] == 0).all()
        assert not inside[mesh.camera.project(mesh.vertices)[:, 0] < -1].any()


class TestUnoccluded:
    def test_behind_the_surface(self):
        """A vertex far behind what is drawn at its pixel is occluded; one on the surface is not."""
        _, mesh, surface = fitted()
        tip = int(np.argmax(mesh.vertices[:, 2]))
        assert unoccluded(surface, mesh, 0.1)[tip] == 1
        assert unoccluded(surface, _moved_back(mesh, tip, 0.15), 0.1)[tip] < 0.75
        assert unoccluded(surface, _moved_back(mesh, tip, 0.5), 0.1)[tip] == 0


def _moved_back(mesh: Mesh, vertex: int, distance: float) -> Mesh:
    """One vertex moved away from the camera by some inter-ocular distances."""
    vertices = mesh.vertices.copy()
    vertices[vertex, 2] -= distance * mesh.interocular
    return replace(mesh, vertices=vertices)


class TestFacingCamera:
    def test_a_near_camera_looks_past_the_sides(self):
        """Seen from near by, the same vertex turns further away than seen from afar."""
        _, mesh, _ = fitted()
        near = replace(mesh, camera=replace(mesh.camera, nearness=1 / 300))
        side = int(np.argmax(mesh.vertices[:, 0]))
        assert facing_camera(near)[side] < facing_camera(mesh)[side]
