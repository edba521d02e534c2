"""One random person in several expressions."""

from __future__ import annotations

import numpy as np
import pytest

from graphface.nodes.learning.rendering.expressions import expressive_photos, varied

SMILE = {"mouthSmile": 0.6, "jawOpen": 0.2}


class TestVaried:
    def test_both_sides(self, head):
        """Names with sides move on both, nearly alike; every weight is between 0 and 1 and known to the model."""
        weights = varied(SMILE, head.names, np.random.default_rng(2))
        assert set(weights) <= set(head.names)
        assert all(0 <= weight <= 1 for weight in weights.values())
        assert weights["jawOpen"] > 0.05
        assert abs(weights["mouthSmile_L"] - weights["mouthSmile_R"]) < 0.5 * weights["mouthSmile_L"]


class TestExpressivePhotos:
    def test_depend_on_seed_and_number(self, head):
        """A photograph is the same whatever others are asked for; another number is another photograph."""
        pytest.importorskip("mitsuba", reason="rendering needs mitsuba: pip install 'graphface[truth]'")
        both = dict(expressive_photos(head, 4, (0, 1), size=32, samples=1))
        [(_, alone)] = expressive_photos(head, 4, (1,), size=32, samples=1)
        np.testing.assert_array_equal(both[1], alone)
        assert (both[0] != both[1]).any()
        assert both[0].shape == (32, 32, 3)
        assert 40 < both[0].mean() < 220
