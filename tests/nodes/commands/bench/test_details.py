"""`graphface bench details` on one small photo."""

from __future__ import annotations

import pytest

from graphface.nodes.io.image_write import write_picture


class TestBenchDetails:
    @pytest.mark.filterwarnings("ignore::graphface.GraphfaceWarning")
    def test_table_and_cases(self, command, face, tmp_path):
        """A row for each pair and their mean, and a folder for each pair."""
        write_picture(face, tmp_path / "me.png")
        (tmp_path / "pairs.csv").write_text("me.png, me.png, nose\n")
        said = command("bench", "details", tmp_path / "pairs.csv", "--out", tmp_path / "out", "--variant", "older")
        assert said.code == 0, said.err
        assert "mean" in said.out
        assert (tmp_path / "out" / "me_me" / "warped.png").is_file()

    def test_unknown_variant(self, command, face, tmp_path):
        """It is named."""
        write_picture(face, tmp_path / "me.png")
        (tmp_path / "pairs.csv").write_text("me.png, me.png\n")
        said = command("bench", "details", tmp_path / "pairs.csv", "--variant", "oldr")
        assert said.code == 2
        assert "older" in said.err
