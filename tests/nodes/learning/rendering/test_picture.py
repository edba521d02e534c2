"""A random person, photographed."""

from __future__ import annotations

import numpy as np
import pytest

from graphface.nodes.learning.rendering.example import BARE_SKIN, EYES_AND_TEETH, REST
from graphface.nodes.learning.rendering.picture import make_example


class TestMakeExample:
    def test_a_head(self, head):
        """A tiny picture: a lit face with unit normals, labels and light that reaches it; the same every time."""
        pytest.importorskip("mitsuba", reason="rendering needs mitsuba: pip install 'graphface[truth]'")
        found, again = (make_example(head, 5, size=48, samples=1) for _ in range(2))
        np.testing.assert_array_equal(found.photo, again.photo)
        on = found.labels != REST
        lengths = np.linalg.norm(found.normals[on].astype(float), axis=1)
        assert abs(lengths - 127).max() < 2
        assert (found.labels == BARE_SKIN).mean() > 0.2
        assert (found.labels == EYES_AND_TEETH).any()
        assert found.visibility[on].mean() > 60
        assert found.photo[on].mean() > 20
