"""`graphface bench matting` on one small photo."""

from __future__ import annotations

from graphface.nodes.io.image_write import write_picture


class TestBenchMatting:
    def test_table(self, command, face, tmp_path):
        """Both ways find nearly the same alphas; seconds of both, and their ratio."""
        write_picture(face, tmp_path / "me.png")
        said = command("bench", "matting", tmp_path / "me.png")
        assert said.code == 0, said.err
        size, band, whole, _, ratio, apart, _ = said.figures("me")
        assert size == "128x128"
        assert 0 < float(band) < 100
        assert float(whole) > 0
        assert float(ratio) > 0
        assert float(apart) < 0.01

    def test_missing_photo(self, command, tmp_path):
        """A photo that does not exist is named."""
        said = command("bench", "matting", tmp_path / "none.png")
        assert said.code == 2
        assert "none.png" in said.err
