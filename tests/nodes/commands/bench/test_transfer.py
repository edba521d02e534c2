"""`graphface bench transfer` on one small photo."""

from __future__ import annotations

import pytest

from graphface.nodes.io.image_read import read_image
from graphface.nodes.io.image_write import write_picture


class TestBenchTransfer:
    @pytest.mark.filterwarnings("ignore::graphface.GraphfaceWarning")
    def test_table_and_picture(self, command, face, tmp_path):
        """Eight columns of figures for each pair; the picture has references along the top and photos on the left."""
        write_picture(face, tmp_path / "me.png")
        table = tmp_path / "table.png"
        said = command("bench", "transfer", tmp_path / "me.png", tmp_path / "me.png", "--table", table)
        assert said.code == 0, said.err
        reference, *figures = said.figures("me.png")
        assert reference == "me.png"
        assert len(figures) == 7
        assert float(figures[-1]) >= 0
        assert (read_image(table).width, read_image(table).height) == (720, 720)

    @pytest.mark.filterwarnings("ignore::graphface.GraphfaceWarning")
    def test_cases(self, command, face, tmp_path):
        """--out writes a folder for each pair, and prints what is seen."""
        write_picture(face, tmp_path / "me.png")
        out = tmp_path / "out"
        said = command("bench", "transfer", tmp_path / "me.png", tmp_path / "me.png", "--out", out, "--long-side", 120)
        assert said.code == 0, said.err
        assert (out / "me_from_me" / "warped.png").is_file()
        assert len(said.figures("me")) == 7

    def test_missing_photo(self, command, tmp_path):
        """A photo that does not exist is named."""
        said = command("bench", "transfer", tmp_path / "none.png", tmp_path / "none.png")
        assert said.code == 2
        assert "none.png" in said.err
