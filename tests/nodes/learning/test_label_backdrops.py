"""Backdrops of training pictures."""

from __future__ import annotations

import numpy as np
from drawn import PICTURE
from hypothesis import given, settings
from hypothesis import strategies as st

from graphface.nodes.learning.label_backdrops import backdrop, padding
from graphface.nodes.masks.upright_grid import HEIGHT, WIDTH


class TestBackdrop:
    @given(st.integers(0, 10_000))
    @settings(max_examples=40, deadline=None)
    def test_any(self, seed):
        """Every kind has the grid's size and displayable colors, whether or not the head's colors are known."""
        for own in ([], [np.array([0.8, 0.6, 0.5])]):
            found = backdrop([PICTURE], own, np.random.default_rng(seed))
            assert found.shape == (HEIGHT, WIDTH, 3)
            assert found.dtype == np.float32
            assert np.isfinite(found).all()
            assert found.min() >= 0
            assert found.max() <= 1

    def test_the_same_again(self):
        """The same seed, the same backdrop."""
        one, other = (backdrop([PICTURE], [], np.random.default_rng(3)) for _ in range(2))
        np.testing.assert_array_equal(one, other)

    def test_some_look_like_the_head(self):
        """Walls of the color of the skin or the hair are among them."""
        skin = np.array([0.8, 0.5, 0.35])
        means = [backdrop([PICTURE], [skin], np.random.default_rng(seed)).mean(axis=(0, 1)) for seed in range(60)]
        assert min(np.abs(mean - skin).max() for mean in means) < 0.1


class TestPadding:
    def test_beside_the_face(self):
        """Some of the grid is margin, the middle of the face never."""
        middle = np.array([WIDTH / 2, HEIGHT / 2], np.float32)
        for seed in range(10):
            found = padding(middle, np.random.default_rng(seed))
            assert found.shape == (HEIGHT, WIDTH)
            assert found[HEIGHT // 2, WIDTH // 2] == 0
            assert found.max() == 1
