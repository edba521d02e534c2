"""Lights as values."""

from __future__ import annotations

import numpy as np
import pytest

from graphface.nodes.types import Lighting


class TestLighting:
    @pytest.mark.parametrize(("count", "order"), [(1, 0), (4, 1), (9, 2), (16, 3)])
    def test_order(self, count, order):
        """By the number of coefficients, in one channel or three."""
        assert Lighting(np.zeros(count, np.float32)).order == order
        assert Lighting(np.zeros((count, 3), np.float32)).order == order
