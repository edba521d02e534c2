"""Label weights as a graph input."""

from __future__ import annotations

import numpy as np

from graphface.nodes.masks.files import LABEL_WEIGHTS
from graphface.nodes.masks.label_weights import SHIPPED, shipped_weights


class TestLabelWeights:
    def test_read(self):
        """A file of weights is read as the operator's input."""
        found = LABEL_WEIGHTS.read(SHIPPED).arrays
        assert sorted(found) == sorted(shipped_weights())
        np.testing.assert_array_equal(found["out.weight"], shipped_weights()["out.weight"])
