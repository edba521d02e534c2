"""Types of arrays: name and description."""

from __future__ import annotations

import pytest

from graphface.nodes import types
from graphface.values.port_types import array_of


class TestArrayTypes:
    @pytest.mark.parametrize(
        "name",
        [
            "Mask",
            "Normals",
            "Depth",
            "Albedo",
            "Shading",
            "Detail",
            "Direction",
            "Gain",
            "FaceCoordinates",
            "Visibility",
        ],
    )
    def test_are_named_and_described(self, name):
        """The name in graph files, and a sentence."""
        kind = array_of(getattr(types, name))
        assert kind.name == name
        assert kind.doc.endswith(".")
