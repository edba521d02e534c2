"""The mesh over the photo."""

from __future__ import annotations

import numpy as np

from graphface.nodes.overlay.mesh import mesh
from graphface.nodes.types import Camera, Image, Mesh


def triangle(*, turned_away: bool = False, far: float = 0.0) -> Mesh:
    """One triangle in a picture of 40 x 40, moved to the right by `far`."""
    vertices = np.float32([[-10, -10, 0], [10, -10, 0], [0, 10, 0]]) + np.float32([far, 0, 0])
    corners = [[0, 2, 1]] if turned_away else [[0, 1, 2]]
    normals = np.tile(np.float32([0, 0, 1]), (3, 1))
    return Mesh(vertices, np.array(corners, np.int32), normals, Camera(center=(20.0, 20.0)), 10.0)


def drawn(face: Mesh) -> np.ndarray:
    return mesh(Image(np.zeros((40, 40, 3), np.float32)), face, strength=1).pixels.max(axis=2)


class TestMesh:
    def test_edges_are_drawn(self):
        """The lower edge is a line from corner to corner; the middle of the triangle stays empty."""
        picture = drawn(triangle())
        assert picture[30, 12:29].min() > 0.5
        assert picture[24:27, 19:22].max() == 0

    def test_triangles_that_face_away_are_left_out(self):
        """What is seen from behind is not drawn."""
        assert drawn(triangle(turned_away=True)).max() == 0

    def test_far_outside(self):
        """Coordinates beyond what OpenCV can draw do no harm."""
        assert drawn(triangle(far=1e9)).max() == 0
