"""The prior over coefficients, learned."""

from __future__ import annotations

import numpy as np

from graphface.nodes.learning.coefficient_prior import fit_mixture


class TestFitMixture:
    def test_bic_finds_two_clusters(self, rng):
        """Two clouds far apart are two components or more, one cloud is one."""
        clouds = np.concatenate([rng.normal(size=(150, 2)) - 6, rng.normal(size=(150, 2)) + 6])
        assert len(fit_mixture(clouds).weights) == 2
        assert len(fit_mixture(rng.normal(size=(300, 2))).weights) == 1
