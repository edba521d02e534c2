"""Relief that the model does not know."""

from __future__ import annotations

import numpy as np
import pytest

from graphface.nodes.learning.rendering.head_model import SKIN
from graphface.nodes.learning.rendering.relief import relief


class TestRelief:
    @pytest.mark.parametrize("seed", range(4))
    def test_millimetres_of_skin(self, head, seed):
        """Skin moves by up to a few millimetres, eyes and teeth not at all."""
        heights = relief(head, head.refinement @ head.mean, np.random.default_rng(seed))
        assert not heights[head.part != SKIN].any()
        assert 0 < np.abs(heights).max() < 0.6
