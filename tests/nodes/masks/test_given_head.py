"""Head masks that the user gives."""

from __future__ import annotations

import numpy as np
import pytest

from graphface import RunFailed, UsageError, load
from graphface.nodes.masks.given_head import given_head
from graphface.nodes.types import HeadMasks

ZERO, ONE = np.zeros((2, 2), np.float32), np.ones((2, 2), np.float32)


class TestGivenHead:
    def test_each_mask_on_its_own(self):
        """Each of the three masks can be replaced on its own."""
        found = given_head(HeadMasks(ZERO, ZERO, ZERO), None, ONE)
        assert found.normal.all()
        assert not found.conservative.any()

    def test_all_given(self):
        """With every mask given, the computed ones may be missing."""
        assert given_head(None, ZERO, ONE, ONE).normal.all()

    @pytest.mark.parametrize(
        ("given", "missing"), [({}, "conservative, normal, aggressive"), ({"normal": ONE}, "conservative, aggressive")]
    )
    def test_neither_given_nor_computed(self, given, missing):
        """The message names the operator and the masks that are missing."""
        with pytest.raises(UsageError, match=rf"masks.given_head: .* plugged in for {missing};"):
            given_head(None, **given)

    def test_in_place_of_the_projected_masks(self, make_face):
        """Swapped in where nothing is given, it fails with that message."""
        photo, landmarks, _, surface = make_face()
        graph = load("segment", replace={"projected": "masks.given_head"})
        with pytest.raises(RunFailed, match=r"masks.given_head: neither a given mask nor a computed one"):
            graph.run(["masks"], photo=photo, landmarks=landmarks, surface=surface)
