"""Pins set by hand, and the picture of a correspondence."""

import numpy as np
import pytest

from graphface import UnreadableFile
from graphface.nodes.io.pins import read_pins
from graphface.nodes.types import Correspondence, Pins


class TestPins:
    def test_from_a_file(self, tmp_path):
        """Four numbers a line; comments and empty lines do not count."""
        (tmp_path / "p.txt").write_text("# eyes\n1 2 3 4\n\n5, 6, 7, 8  # left\n")
        np.testing.assert_array_equal(read_pins(tmp_path / "p.txt").points, [[1, 2, 3, 4], [5, 6, 7, 8]])

    @pytest.mark.parametrize("line", ["1 2 3", "1 2 3 x", "1 2 3 nan", "1 2 3 4 5"])
    def test_a_wrong_line_is_named(self, tmp_path, line):
        """The error says which line is wrong."""
        (tmp_path / "p.txt").write_text(f"1 2 3 4\n{line}\n")
        with pytest.raises(UnreadableFile, match="line 2"):
            read_pins(tmp_path / "p.txt")

    def test_an_empty_file_has_none(self, tmp_path):
        """No line, no pin."""
        (tmp_path / "p.txt").write_text("")
        assert read_pins(tmp_path / "p.txt").points.shape == (0, 4)

    @pytest.mark.parametrize("value", [[1, 2, 3, 4], [[1, 2, 3]], [[1, 2, 3, np.inf]]])
    def test_another_shape(self, value):
        """Arrays are (n, 4) and finite."""
        with pytest.raises(ValueError, match="shape"):
            Pins.coerce(value)


class TestPicture:
    def test_unknown_is_grey(self):
        """Where nothing corresponds the board is mid grey."""
        nothing = np.zeros((4, 4), np.float32)
        drawn = Correspondence.picture(Correspondence(np.zeros((4, 4, 2), np.float32), nothing, nothing, (4, 4)))
        assert drawn.shape == (4, 4, 3)
        assert set(np.unique(drawn)) == {128}
