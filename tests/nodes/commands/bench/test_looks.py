"""`graphface bench looks` on one small photo."""

from __future__ import annotations

import pytest

from graphface.nodes.io.image_write import write_picture


class TestBenchLooks:
    @pytest.mark.filterwarnings("ignore::graphface.GraphfaceWarning")
    def test_table_and_cases(self, command, face, tmp_path):
        """A row for each scene, and a folder for each photo and scene."""
        write_picture(face, tmp_path / "me.png")
        said = command("bench", "looks", tmp_path / "me.png", "--out", tmp_path / "out", "--long-side", 100)
        assert said.code == 0, said.err
        assert said.figures("window-left")[0] == "1"
        assert (tmp_path / "out" / "split" / "me" / "result.png").is_file()

    def test_unknown_scene(self, command, face, tmp_path):
        """It is named."""
        write_picture(face, tmp_path / "me.png")
        said = command("bench", "looks", tmp_path / "me.png", "--scene", "candel")
        assert said.code == 2
        assert "candle" in said.err
