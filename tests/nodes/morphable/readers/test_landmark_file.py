"""Vertices of the iBUG points from a text file."""

from __future__ import annotations

import pytest

from graphface import UnreadableFile
from graphface.nodes.morphable.readers.landmark_file import read_landmark_numbers


class TestLandmarkFile:
    @pytest.mark.parametrize(("text", "reason"), [("nothing", "no line"), ("99 = 3", "no iBUG point 99")])
    def test_wrong_files_are_named(self, tmp_path, text, reason):
        """A file without a mapping, or with numbers beyond 68."""
        (tmp_path / "points.txt").write_text(text)
        with pytest.raises(UnreadableFile, match=reason):
            read_landmark_numbers(tmp_path / "points.txt")
