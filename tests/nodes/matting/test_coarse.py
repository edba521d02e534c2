"""The coarse space: functions linear in the color of a block."""

from __future__ import annotations

import numpy as np

from graphface.nodes.matting.coarse import color_lines


class TestColorLines:
    def test_spans_linear_functions_of_color(self, rng):
        """Any function linear in the color over a block is a sum of its columns."""
        colors, unknown = rng.uniform(size=(13, 9, 3)), rng.uniform(size=(13, 9)) < 0.7
        functions = color_lines(colors, unknown, 4)
        y, x = np.nonzero(unknown)
        wanted = (colors[unknown] @ [1.0, -2.0, 0.5] + 0.3) * ((y < 4) & (x >= 4) & (x < 8))
        rest = wanted - functions @ np.linalg.lstsq(functions.toarray(), wanted, rcond=None)[0]
        assert np.abs(rest).max() < 1e-9

    def test_nothing_unknown(self):
        """No pixels, no functions."""
        assert color_lines(np.zeros((4, 4, 3)), np.zeros((4, 4), bool)).shape == (0, 0)
