"""`graphface bench makeup` on one small head, whose makeup is its own."""

from __future__ import annotations

import pytest

from graphface.nodes.io.image_write import write_picture


class TestBenchMakeup:
    @pytest.mark.filterwarnings("ignore::graphface.GraphfaceWarning")
    def test_table(self, command, heads, face, tmp_path):
        """METHOD/A_from_B.png; simple methods without a time, the graph with one."""
        (heads / "truth/makeup").mkdir()
        write_picture(face, heads / "truth/makeup/gt01_from_gt01.png")
        said = command("bench", "makeup", tmp_path / "out", "--data", heads, "--no-swaps")
        assert said.code == 0, said.err
        methods = ("unchanged", "reinhard", "pasted", "makeup", "paper")
        assert all((tmp_path / "out" / method / "gt01_from_gt01.png").is_file() for method in methods)
        assert len(said.figures("unchanged")) == 2
        psnr, _, spent, ratio = said.figures("paper")
        assert float(psnr) > 30
        assert float(spent) > 0
        assert float(ratio) > 0

    def test_no_pairs(self, command, tmp_path):
        """A folder without pairs is named."""
        said = command("bench", "makeup", tmp_path / "out", "--data", tmp_path)
        assert said.code == 2
        assert "holds no pairs" in said.err
