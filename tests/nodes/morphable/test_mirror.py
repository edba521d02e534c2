"""Mirror images of vertices."""

from __future__ import annotations

import numpy as np
from faces import grid_model

from graphface.nodes.morphable.builtin import builtin_model
from graphface.nodes.morphable.mirror import mirror_vertices


class TestMirrorVertices:
    def test_of_the_builtin_model(self):
        """Every vertex of the mean has a mirror partner."""
        model = builtin_model()
        mirror = mirror_vertices(model)
        np.testing.assert_allclose(model.mean[mirror] * (-1, 1, 1), model.mean, atol=5e-3)

    def test_of_an_asymmetric_model(self):
        """A model that is not symmetric has no mirror pairs."""
        mean = grid_model().mean.copy()
        mean[:, 0] += 0.1 * mean[:, 1]
        assert mirror_vertices(grid_model(mean=mean)) is None
