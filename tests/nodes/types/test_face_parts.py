"""Masks of parts of the face."""

from __future__ import annotations

import numpy as np

from graphface.nodes.types import Features


def features(**masks):
    nothing = np.zeros((2, 2), np.float32)
    names = ("eyes", "mouth", "lips", "around", "lids", "brows", "nose", "cheeks")
    return Features(**{name: np.float32(masks.get(name, nothing)) for name in names})


class TestFeatures:
    def test_any_of(self):
        """The largest of some masks, in a new array."""
        made = features(eyes=[[0.2, 0], [0, 1]], mouth=[[0.5, 0], [0, 0]])
        np.testing.assert_array_equal(made.any_of("eyes", "mouth"), np.float32([[0.5, 0], [0, 1]]))
        assert made.any_of("eyes") is not made.eyes
