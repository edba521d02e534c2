"""The mesh's own mask: soft inside, nothing outside."""

from __future__ import annotations

import numpy as np
import pytest

from graphface import GraphfaceWarning
from graphface.nodes.masks.face import face
from graphface.nodes.types import Landmarks, Surface


def surface_of(coverage):
    coverage = coverage.astype(np.float32)
    flat = np.zeros((*coverage.shape, 3), np.float32)
    return Surface(flat, coverage * 0, coverage, np.zeros(coverage.shape, np.int32), flat)


def landmarks_with(interocular):
    points = np.zeros((468, 3), np.float32)
    points[263, 0] = interocular
    return Landmarks(points, "facemesh468")


def disc(side, radius):
    y, x = np.mgrid[:side, :side] - side // 2
    return x * x + y * y <= radius * radius


class TestFace:
    def test_never_beyond_the_mesh(self):
        """Zero where the mesh does not cover."""
        coverage = disc(101, 40)
        assert not face(surface_of(coverage), landmarks_with(40))[~coverage].any()

    def test_full_deep_inside_and_falling_outwards(self):
        """One in the middle, never rising on the way out."""
        row = face(surface_of(disc(101, 40)), landmarks_with(40))[50, 50:]
        assert row[0] == 1
        assert (np.diff(row) <= 1e-6).all()

    def test_softness_is_relative_to_the_face(self):
        """The same face at twice the size has the same mask at twice the size."""
        small = face(surface_of(disc(101, 40)), landmarks_with(40))
        large = face(surface_of(disc(202, 80)), landmarks_with(80))
        np.testing.assert_allclose(large[101, 101::2], small[50, 50:101], atol=0.06)

    def test_not_faded_along_the_frame(self):
        """A face cut by the frame is full at the cut."""
        coverage = np.zeros((60, 60), bool)
        coverage[:, :40] = True
        assert face(surface_of(coverage), landmarks_with(20))[30, 0] == 1

    def test_empty_mesh_warns(self):
        """No coverage: an empty mask and a warning."""
        with pytest.warns(GraphfaceWarning, match="covers no pixel"):
            assert not face(surface_of(np.zeros((5, 5))), landmarks_with(3)).any()

    def test_full_coverage_is_a_full_mask(self):
        """A face that fills the frame has no edge to fade along."""
        assert (face(surface_of(np.ones((5, 5))), landmarks_with(3)) == 1).all()

    @pytest.mark.parametrize("interocular", [0.0, 0.1, 1e6])
    def test_one_pixel_keeps_some_weight(self, interocular):
        """A face of one pixel is not lost, whatever its landmarks say."""
        coverage = np.zeros((5, 5))
        coverage[2, 2] = 1
        mask = face(surface_of(coverage), landmarks_with(interocular))
        assert 0 < mask[2, 2] <= 1
        assert np.isfinite(mask).all()
