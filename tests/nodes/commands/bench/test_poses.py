"""`graphface bench poses`."""

from __future__ import annotations


class TestBenchPoses:
    def test_no_data(self, command, tmp_path):
        """A folder without points is named."""
        said = command("bench", "poses", "--data", tmp_path)
        assert said.code == 2
        assert "68 points" in said.err

    def test_table(self, command, networks, shared):
        """A row for each set of photographs."""
        said = command("bench", "poses", "--data", shared, "--every", 200)
        assert said.code == 0, said.err
        for title in ("large poses", "automatic points", "portraits"):
            assert title in said.out
