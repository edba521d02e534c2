"""`graphface bench intrinsic` on one small head."""

from __future__ import annotations


class TestBenchIntrinsic:
    def test_table_and_csv(self, command, heads, tmp_path):
        """A row for each method asked for, with the time beside the first one's; every figure in the file."""
        csv = tmp_path / "figures.csv"
        methods = ("--method", "intensity", "--method", "intrinsic.retinex")
        said = command("bench", "intrinsic", "--data", heads, *methods, "--csv", csv)
        assert said.code == 0, said.err
        *errors, spent, ratio = said.figures("intrinsic.intensity")
        assert len(errors) == 4
        assert float(spent) > 0
        assert float(ratio) == 1
        assert said.figures("intrinsic.retinex")
        lines = csv.read_text().splitlines()
        assert lines[0].startswith("method,head,light,")
        assert len(lines) == 1 + 2 * 6

    def test_unknown_method(self, command, heads):
        """The nearest name is told."""
        said = command("bench", "intrinsic", "--data", heads, "--method", "retinx")
        assert said.code == 2
        assert "intrinsic.retinex" in said.err
