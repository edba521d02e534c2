"""`graphface bench geometry` on one small head."""

from __future__ import annotations


class TestBenchGeometry:
    def test_table(self, command, heads):
        """A row for each geometry: no landmarks where none are known, then normals, depth, time, and its ratio."""
        said = command("bench", "geometry", "--data", heads)
        assert said.code == 0, said.err
        for name in ("facemesh", "morphable, builtin", "average, builtin"):
            light, normals, _, spent, ratio = said.figures(name)
            assert light == "all"
            assert 0 < float(normals) < 90
            assert float(spent) > 0
            assert float(ratio) > 0

    def test_each_light(self, command, heads):
        """A row for each light and one for all."""
        said = command("bench", "geometry", "--data", heads, "--lights")
        assert said.code == 0, said.err
        assert sum("average, builtin" in line for line in said.out.splitlines()) == 8

    def test_no_heads(self, command, tmp_path):
        """A folder without heads is named."""
        said = command("bench", "geometry", "--data", tmp_path)
        assert said.code == 2
        assert "holds no heads" in said.err
