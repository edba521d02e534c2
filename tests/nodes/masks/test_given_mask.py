"""What the operators for given masks share."""

from __future__ import annotations

import numpy as np
import pytest

from graphface import UsageError
from graphface.nodes.masks.given_mask import checked_masks, unless_all_given

ONE = np.ones((2, 3), np.float32)


class TestUnlessAllGiven:
    def test_needs(self):
        """The computed value is declined only where every mask is given."""
        assert unless_all_given(a=ONE, b=None) == {"computed": True}
        assert unless_all_given(a=ONE, b=ONE) == {"computed": "every map is given"}


class TestCheckedMasks:
    def test_values_are_clipped(self):
        """Masks lie in [0, 1]; NaN is 0; masks that are not given are left out."""
        mask = np.array([[np.nan, -1, 2], [np.inf, -np.inf, 0.5]], np.float32)
        found = checked_masks("masks.given_x", {"a": mask, "b": None}, (2, 3))
        assert list(found) == ["a"]
        assert found["a"].tolist() == [[0, 0, 1], [1, 0, 0.5]]

    def test_sizes(self):
        """A mask of another size than the computed or the other given ones is refused."""
        with pytest.raises(UsageError, match="given b mask is 3 x 2 pixels"):
            checked_masks("masks.given_x", {"a": np.ones((4, 4), np.float32), "b": ONE}, None)
