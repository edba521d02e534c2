"""Files of pins."""

from __future__ import annotations

import numpy as np
import pytest

from graphface import UnreadableFile
from graphface.nodes.io.pins import read_pins


class TestReadPins:
    def test_from_a_file(self, tmp_path):
        """Four numbers a line; comments and empty lines do not count."""
        (tmp_path / "p.txt").write_text("# eyes\n1 2 3 4\n\n5, 6, 7, 8  # left\n")
        np.testing.assert_array_equal(read_pins(tmp_path / "p.txt").points, [[1, 2, 3, 4], [5, 6, 7, 8]])

    @pytest.mark.parametrize("line", ["1 2 3", "1 2 3 x", "1 2 3 nan", "1 2 3 4 5"])
    def test_a_wrong_line_is_named(self, tmp_path, line):
        """The error has the number of the line."""
        (tmp_path / "p.txt").write_text(f"1 2 3 4\n{line}\n")
        with pytest.raises(UnreadableFile, match="line 2"):
            read_pins(tmp_path / "p.txt")

    def test_an_empty_file_has_none(self, tmp_path):
        """No line, no pin."""
        (tmp_path / "p.txt").write_text("")
        assert read_pins(tmp_path / "p.txt").points.shape == (0, 4)
