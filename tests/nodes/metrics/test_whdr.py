"""Weighted human disagreement rate."""

from __future__ import annotations

import numpy as np
import pytest

from graphface.nodes.metrics.whdr import whdr
from graphface.nodes.types import (
    Judgement,
    Judgements,
)


class TestWhdr:
    def test_counts_weighted_disagreement(self):
        """Right judgements cost nothing, wrong ones their weight."""
        albedo = np.ones((2, 2, 3), np.float32)
        albedo[:, 0] = 0.5
        left, right = (0.1, 0.5), (0.9, 0.5)
        right_one = Judgement(left, right, "1", weight=3)
        wrong_one = Judgement(left, right, "E", weight=1)
        assert whdr(albedo, Judgements((right_one, wrong_one))) == pytest.approx(0.25)

    def test_needs_a_judgement(self):
        """Without any there is no rate."""
        with pytest.raises(ValueError, match="no judgement"):
            whdr(np.ones((2, 2, 3), np.float32), Judgements(()))
