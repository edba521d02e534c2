"""Intersection over union."""

from __future__ import annotations

import numpy as np
import pytest

from graphface.nodes.metrics.iou import iou


class TestIou:
    def test_iou_of_soft_masks(self):
        """Minima over maxima; two empty masks agree."""
        half = np.full((2, 2), 0.5, np.float32)
        assert iou(half, np.ones((2, 2), np.float32)) == pytest.approx(0.5)
        assert iou(half * 0, half * 0) == 1
