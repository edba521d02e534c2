"""The 68 points among the 468."""

import numpy as np

from graphface.nodes.landmark_schemes import IBUG68_IN_FACEMESH468, POINTS, ibug68
from graphface.nodes.types import Landmarks


class TestIbug68:
    def test_numbers(self):
        """68 different vertices of the mesh."""
        assert len(IBUG68_IN_FACEMESH468) == len(set(IBUG68_IN_FACEMESH468.tolist())) == POINTS["ibug68"]
        assert IBUG68_IN_FACEMESH468.max() < POINTS["facemesh468"]

    def test_same_eyes(self):
        """Both schemes measure the inter-ocular distance between the same points."""
        points = np.random.default_rng(0).normal(size=(468, 3)).astype(np.float32)
        mesh = Landmarks(points, "facemesh468", 0.7, 3)
        reduced = ibug68(mesh)
        assert reduced.interocular == mesh.interocular
        assert (reduced.score, reduced.faces) == (0.7, 3)

    def test_already(self):
        """68 points stay what they are."""
        points = Landmarks(np.zeros((68, 3), np.float32), "ibug68")
        assert ibug68(points) is points
