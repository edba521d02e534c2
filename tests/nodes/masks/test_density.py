"""Kernel density and mixtures behind one interface."""

from __future__ import annotations

import numpy as np
import pytest

from graphface import GraphfaceWarning
from graphface.nodes.masks.density import SAMPLES, density_model, sampled


class TestDensityModel:
    @pytest.mark.parametrize("model", ["parzen", "mixture"])
    def test_likely_where_learned(self, model, rng):
        """Pixels like the samples are likely, others are not."""
        values = rng.normal(np.repeat([[0.2], [0.8]], 200, axis=0), 0.02, (400, 3)).astype(np.float32)[None]
        found = density_model(values, model, 4).log_density(np.repeat(np.float32([1, 0]), 200), pseudo_count=1.0)
        assert found.dtype == np.float32
        assert found[:200].mean() > found[200:].mean() + 2

    @pytest.mark.parametrize("model", ["parzen", "mixture"])
    def test_without_samples(self, model, rng):
        """Without samples no pixel is likelier than another, relative to the marginal density."""
        density = density_model(rng.uniform(0, 1, (9, 9, 3)).astype(np.float32), model, 4)
        assert np.ptp(density.log_density(np.zeros(81, np.float32)) - density.log_marginal) < 1e-3

    def test_no_finite_features(self):
        """A mixture without a finite pixel is constant, with a warning."""
        with pytest.warns(GraphfaceWarning, match="no pixel has finite features"):
            density = density_model(np.full((4, 4, 3), np.nan, np.float32), "mixture", 4)
        assert not density.log_marginal.any()


class TestSampled:
    def test_number(self):
        """About as many as asked for, all of them chosen pixels."""
        where = np.arange(100_000) % 2 == 0
        found = sampled(where)
        assert where[found].all()
        assert len(found) == pytest.approx(SAMPLES, rel=0.1)

    def test_one_pixel_more_changes_little(self):
        """One chosen pixel more keeps nearly all samples."""
        where = np.arange(100_000) % 2 == 0
        more = where.copy()
        more[1] = True
        assert len(np.setxor1d(sampled(where), sampled(more))) < 5
