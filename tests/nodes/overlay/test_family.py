"""What all drawings over a photo have in common."""

from __future__ import annotations

import numpy as np
import pytest
from faces import fitted

from graphface.nodes.overlay.checkerboard import checkerboard
from graphface.nodes.overlay.depth import depth
from graphface.nodes.overlay.mesh import mesh as draw_mesh
from graphface.nodes.overlay.normals import normals


class TestOverlay:
    @pytest.mark.parametrize("draw", [draw_mesh, normals, depth, checkerboard])
    def test_draws_on_the_face_only(self, draw):
        """The face changes, the rest does not; values stay in range."""
        photo, mesh, surface = fitted(20)
        arguments = {draw_mesh: (mesh,), checkerboard: (mesh, surface)}.get(draw, (surface,))
        drawn = draw(photo, *arguments).pixels
        change = np.abs(drawn - photo.pixels).max(axis=2)
        assert change[surface.coverage > 0].mean() > 0.02
        far = np.ones_like(change, bool)
        rows, columns = np.nonzero(surface.coverage)
        far[rows.min() - 3 : rows.max() + 4, columns.min() - 3 : columns.max() + 4] = False
        assert not change[far].any()
        assert 0 <= drawn.min() <= drawn.max() <= 1

    @pytest.mark.parametrize("draw", [draw_mesh, normals, depth, checkerboard])
    def test_no_strength(self, draw):
        """Strength 0 leaves the photo as it is."""
        photo, mesh, surface = fitted(20)
        arguments = {draw_mesh: (mesh,), checkerboard: (mesh, surface)}.get(draw, (surface,))
        np.testing.assert_array_equal(draw(photo, *arguments, strength=0).pixels, photo.pixels)
