"""The table of results."""

from __future__ import annotations

import pytest

from graphface.nodes.bench.transfer_table import face_crop


class TestFaceCrop:
    @pytest.mark.parametrize("side", [16, 300])
    def test_square(self, make_face, side):
        """The crop has the size that was asked for, smaller or larger than the face."""
        photo, landmarks, _, _ = make_face(size=200, scale=0.45)
        assert face_crop(photo, landmarks, side).shape == (side, side, 3)
