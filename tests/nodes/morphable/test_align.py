"""Shapes aligned by position, scale and rotation."""

from __future__ import annotations

import numpy as np
import pytest
from faces import rotation_of
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from graphface.nodes.morphable.align import aligned, procrustes_mean


class TestAligned:
    @given(st.integers(0, 1000))
    def test_undoes_any_similarity(self, seed):
        """Position, size and turn are taken off exactly; a mirror image is not turned into the face."""
        rng = np.random.default_rng(seed)
        target = rng.normal(size=(9, 3))
        rotation = rotation_of(*rng.uniform(-180, 180, size=3))
        posed = rng.uniform(0.1, 50) * target @ rotation.T + rng.normal(size=3)
        np.testing.assert_allclose(aligned(posed[None], target)[0][0], target, atol=1e-8)
        assert np.linalg.det(aligned(posed[None] * (-1, 1, 1), target)[1][0]) == pytest.approx(1)

    @given(arrays(np.float64, (2, 4, 3), elements=st.floats(-1e6, 1e6)))
    def test_stays_finite(self, shapes):
        """Coincident and collinear shapes give numbers."""
        assert np.isfinite(aligned(shapes, shapes[0])[0]).all()
        assert np.isfinite(procrustes_mean(shapes, shapes[0])).all()
