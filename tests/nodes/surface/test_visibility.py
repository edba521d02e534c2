"""How far each vertex is seen."""

from __future__ import annotations

from faces import fitted

from graphface.nodes.surface.visibility import visibility


class TestVisibility:
    def test_a_turned_head_hides_its_far_side(self):
        """Of a face turned right, the vertices far on its own far side are hidden, the near cheek is seen."""
        _, mesh, surface = fitted(60)
        shown = visibility(surface, mesh)
        assert shown[234] > 0.9  # near the ear that is turned to the camera
        assert shown[454] == 0  # near the other
        assert 0.2 < shown.mean() < 0.9

    def test_outside_the_frame_nothing_is_fitted(self):
        """Vertices beyond the picture's edge do not count as seen."""
        _, mesh, surface = fitted(center=(0.0, 150.0))
        outside = mesh.camera.project(mesh.vertices)[:, 0] < -1
        assert outside.any()
        assert not visibility(surface, mesh)[outside].any()
