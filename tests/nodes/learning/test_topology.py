"""The topology of FaceMesh's points, learned from faces."""

from __future__ import annotations

import numpy as np

from graphface.nodes.learning.topology import learn_topology
from graphface.nodes.morphable.topology import facemesh_topology


class TestLearnTopology:
    def test_recovers_it_from_posed_shapes(self, rng):
        """Rotated, scaled, noisy copies of the mean give the same mirror pairs, and as many triangles."""
        shapes = []
        for _ in range(8):
            rotation = np.linalg.qr(rng.normal(size=(3, 3)))[0]
            rotation *= np.sign(np.linalg.det(rotation))
            noise = rng.normal(scale=1e-4, size=(468, 3))
            shapes.append(
                (facemesh_topology().mean + noise) @ rotation * rng.uniform(50, 500) + rng.normal(size=3) * 100
            )
        learned = learn_topology(np.stack(shapes))
        np.testing.assert_array_equal(learned.mirror, facemesh_topology().mirror)
        assert len(learned.triangles) == len(facemesh_topology().triangles)
