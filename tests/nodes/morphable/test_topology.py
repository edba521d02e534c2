"""Triangles, mirror pairs and mean of FaceMesh's points."""

from __future__ import annotations

from collections import Counter

import numpy as np
import pytest

from graphface.nodes.morphable.topology import cylinder, facemesh_topology


class TestTopology:
    def test_every_point_is_used(self):
        """All 468 points are corners of some triangle."""
        assert set(facemesh_topology().triangles.ravel()) == set(range(468))

    def test_is_one_disc(self):
        """No edge has more than two triangles, and Euler's number is that of a disc: eyes and mouth are covered."""
        triangles = facemesh_topology().triangles
        edges = Counter(tuple(sorted((t[k], t[k - 1]))) for t in triangles.tolist() for k in range(3))
        assert max(edges.values()) == 2
        assert 468 - len(edges) + len(triangles) == 1

    def test_winding_is_consistent(self):
        """Neighbours run along their common edge in opposite directions."""
        directed = Counter((t[k - 1], t[k]) for t in facemesh_topology().triangles.tolist() for k in range(3))
        assert max(directed.values()) == 1

    def test_is_its_own_mirror_image(self):
        """Mirroring the points maps triangles to triangles."""
        topology = facemesh_topology()
        triangles = {tuple(sorted(t)) for t in topology.triangles.tolist()}
        assert {tuple(sorted(t)) for t in topology.mirror[topology.triangles].tolist()} == triangles

    def test_mean_is_symmetric_and_has_unit_size(self):
        """The mean shape is symmetric about x = 0, and its outer eye corners are one apart."""
        topology = facemesh_topology()
        np.testing.assert_allclose(topology.mean[topology.mirror] * (-1, 1, 1), topology.mean, atol=1e-6)
        assert np.linalg.norm(topology.mean[33] - topology.mean[263]) == pytest.approx(1, abs=1e-6)


class TestCylinder:
    def test_is_within_the_unit_square(self):
        """Texture coordinates fill [0, 1] in both axes; the middle of the face has the middle coordinate."""
        mean = facemesh_topology().mean
        found = cylinder(mean)
        np.testing.assert_allclose([found.min(axis=0), found.max(axis=0)], [[0, 0], [1, 1]])
        np.testing.assert_allclose(found[np.abs(mean[:, 0]) < 1e-6, 0], 0.5, atol=1e-6)
