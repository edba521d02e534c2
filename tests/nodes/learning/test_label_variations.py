"""Augmentation of training pictures."""

from __future__ import annotations

import numpy as np
import pytest
from drawn import PICTURE
from hypothesis import given, settings
from hypothesis import strategies as st

from graphface.nodes.learning.label_variations import example
from graphface.nodes.masks.network_input import CHANNELS
from graphface.nodes.masks.upright_grid import HEIGHT, WIDTH


class TestExample:
    @given(st.integers(0, 10_000))
    @settings(max_examples=25, deadline=None)
    @pytest.mark.filterwarnings("ignore::graphface.GraphfaceWarning")
    def test_any_variation(self, seed):
        """Finite, of the network's shapes, labels that sum to 1, weights within 0 and 1."""
        made = example(PICTURE, [PICTURE], np.random.default_rng(seed))
        assert made.cells.shape == (HEIGHT // 2, WIDTH // 2, CHANNELS)
        assert np.isfinite(made.cells).all()
        np.testing.assert_allclose(made.labels.sum(axis=2), 1, atol=1e-4)
        assert made.weight.min() >= 0
        assert made.weight.max() <= 1

    def test_the_same_again(self):
        """The same seed, the same variation."""
        one, other = (example(PICTURE, [PICTURE], np.random.default_rng(5)) for _ in range(2))
        np.testing.assert_array_equal(one.cells, other.cells)

    def test_labels_stay_with_the_face(self):
        """In every variation the middle of the face is face."""
        for seed in range(5):
            made = example(PICTURE, [PICTURE], np.random.default_rng(seed))
            assert made.labels[HEIGHT // 2, WIDTH // 2, 0] > 0.9
