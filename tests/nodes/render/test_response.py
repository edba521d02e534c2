"""How much of added light a pixel reflects."""

from __future__ import annotations

import numpy as np

from graphface.nodes.render.response import response
from graphface.nodes.types import (
    Segmentation,
)

SHAPE = (6, 9)


OLD, NEW = np.full(SHAPE, 0.4, np.float32), np.full(SHAPE, 0.8, np.float32)


def thirds():
    """Face, hair, background from left to right."""
    face, hair, background = (np.zeros(SHAPE, np.float32) for _ in range(3))
    face[:, :3], hair[:, 3:6], background[:, 6:] = 1, 1, 1
    return Segmentation(face, hair, background)


class TestResponse:
    def test_skin_answers_in_full(self):
        """However dark its own shading is."""
        assert (response(OLD / 2, OLD, thirds())[:, :3] == 1).all()

    def test_never_more_than_in_full(self):
        """A pixel brighter than the estimated light, or without light, stays in 0..1."""
        for own, estimated in ((NEW, OLD), (NEW, 0 * OLD), (0 * OLD, 0 * OLD)):
            held = response(own, estimated, thirds())
            assert held.min() >= 0
            assert held.max() <= 1
