"""No matting."""

from __future__ import annotations

import numpy as np
from portraits import landmarks_at

from graphface.nodes.matting.none import none
from graphface.nodes.types import Image, Segmentation


class TestNone:
    def test_unchanged(self):
        """The labels are returned unchanged."""
        labels = Segmentation(*(np.full((4, 4), v, np.float32) for v in (0.5, 0.3, 0.2)))
        assert none(Image(np.zeros((4, 4, 3), np.float32)), labels, landmarks_at(2, 2, 1)) is labels
