"""Hair that the user gives."""

from __future__ import annotations

import numpy as np
import pytest

from graphface import UsageError
from graphface.nodes.masks.given_hair import given_hair
from graphface.nodes.masks.hair import Hair

ZERO, ONE = np.zeros((2, 2), np.float32), np.ones((2, 2), np.float32)


class TestGivenHair:
    def test_given(self):
        """A given mask is both response and mask."""
        found = given_hair(Hair(ZERO, ZERO), ONE)
        assert found.response.all()
        assert found.mask.all()

    def test_computed(self):
        """Without a given mask the computed hair passes as it is."""
        computed = Hair(ZERO, ONE)
        assert given_hair(computed) is computed

    def test_neither_given_nor_computed(self):
        """The message names the operator."""
        with pytest.raises(UsageError, match=r"masks.given_hair: neither a given mask nor a computed one"):
            given_hair(None)
