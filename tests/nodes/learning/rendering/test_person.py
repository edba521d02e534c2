"""A random person, who stays the same in every expression."""

from __future__ import annotations

import numpy as np

from graphface.nodes.learning.rendering.person import dressed, expressed, random_shape


class TestExpressed:
    def test_an_expression_moves_the_mouth_only(self, head):
        """With an open jaw the chin sinks; brows, skin and hair stay."""
        random = np.random.default_rng(1)
        person = dressed(head, random_shape(head, random), random)
        calm, landmarks = expressed(head, person, {})
        opened, moved = expressed(head, person, {"jawOpen": 0.8})
        assert landmarks[8, 1] - moved[8, 1] > 0.5
        np.testing.assert_allclose(moved[17:27], landmarks[17:27], atol=0.05)
        np.testing.assert_array_equal(calm.albedo, opened.albedo)


class TestRandomShape:
    def test_two_people(self, head):
        """Two seeds are two people, of human size."""
        one, other = (random_shape(head, np.random.default_rng(seed)) for seed in (1, 2))
        assert 0.1 < np.linalg.norm(one - other, axis=1).mean() < 3
