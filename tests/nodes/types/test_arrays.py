"""Types of arrays: name, description, picture."""

from __future__ import annotations

import numpy as np
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
        """The name in graph files, a sentence, and a picture that is a picture."""
        kind = array_of(getattr(types, name))
        assert kind.name == name
        assert kind.doc.endswith(".")
        if kind.picture is not None:
            value = np.full((2, 3, 3) if kind.shape == "H W 3" else (2, 3), 0.5, np.float32)
            picture = kind.picture(value)
            assert picture.dtype == np.uint8
            assert picture.shape == (2, 3, 3)
