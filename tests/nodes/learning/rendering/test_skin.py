"""Albedo of a head."""

from __future__ import annotations

import numpy as np
import pytest

from graphface.nodes.learning.rendering.head_model import EYE, SKIN
from graphface.nodes.learning.rendering.skin import coat


class TestCoat:
    @pytest.mark.parametrize("seed", range(3))
    def test_in_range(self, head, seed):
        """Albedo and roughness are physical; hair grows on skin alone."""
        found = coat(head, head.refinement @ head.mean, np.random.default_rng(seed))
        assert 0 < found.albedo.min() <= found.albedo.max() < 1
        assert 0.1 < found.roughness.min() <= found.roughness.max() < 1
        assert not found.hair[head.part != SKIN].any()
        assert found.thickness.min() >= 0
        assert np.isfinite(found.albedo[head.part == EYE]).all()
