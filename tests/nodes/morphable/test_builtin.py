"""The built-in face model."""

from __future__ import annotations

import numpy as np
import pytest

from graphface.nodes.morphable.builtin import BUILTIN, builtin_model


class TestBuiltin:
    def test_is_small_and_says_where_it_comes_from(self):
        """Well under a megabyte, with the command, the figures, the sources and the limits on its card."""
        assert BUILTIN.stat().st_size < 300_000
        card = builtin_model().card
        assert {"command", "figures", "learned_from", "limits", "license"} <= set(card)
        assert card["figures"]["left_unseen"] < 0.15

    def test_unit_and_pose(self):
        """The outer eye corners are about one apart, and the nose points at the viewer."""
        model = builtin_model()
        points = model.mean[model.landmarks["ibug68"]]
        assert np.linalg.norm(points[45] - points[36]) == pytest.approx(1, abs=0.05)
        assert points[30, 2] == points[17:, 2].max()
