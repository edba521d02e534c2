"""A light on a white ball."""

from __future__ import annotations

import numpy as np

from graphface.nodes.sh.ball import ball
from graphface.nodes.types import Lighting


class TestBall:
    def test_shows_the_light_where_it_comes_from(self):
        """Lit from the right, the ball's right is brighter; around it there is nothing."""
        picture = ball(Lighting(np.float32([1, 0, 0, 0.5])), size=64)
        assert picture.pixels[32, 52].mean() > picture.pixels[32, 12].mean() + 0.1
        assert picture.alpha is not None
        assert picture.alpha[0, 0] == 0
        assert picture.alpha[32, 32] == 1
