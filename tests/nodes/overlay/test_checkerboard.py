"""A checkerboard that moves with the face."""

from __future__ import annotations

import numpy as np
from faces import fitted

from graphface.nodes.overlay.checkerboard import checkerboard


class TestCheckerboard:
    def test_squares_move_with_the_face(self):
        """The nose tip has the same square's color in two poses."""
        colors = []
        for yaw in (0, 25):
            photo, mesh, surface = fitted(yaw)
            x, y = np.rint(mesh.camera.project(mesh.vertices[205])).astype(int)
            black = photo.with_pixels(photo.pixels * 0)
            colors.append(checkerboard(black, mesh, surface, cells=4, strength=1).pixels[y, x])
        np.testing.assert_allclose(*colors, atol=1e-6)
