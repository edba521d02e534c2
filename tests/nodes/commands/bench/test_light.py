"""`graphface bench light` on one small head."""

from __future__ import annotations


class TestBenchLight:
    def test_table(self, command, heads):
        """A row for each order and robustness: degrees by fitted and by true normals, time, and its ratio."""
        said = command("bench", "light", "--data", heads)
        assert said.code == 0, said.err
        assert len(said.out.splitlines()) == 1 + 9
        robust, fitted, true, spent, ratio = said.out.splitlines()[1].split()[1:]
        assert robust == "none"
        assert all(0 <= float(angle) <= 180 for angle in (fitted, true))
        assert float(spent) > 0
        assert float(ratio) == 1

    def test_symmetry(self, command, networks, tmp_path):
        """With photographs, a row for each thing that the light may be fitted to."""
        from PIL import Image
        from skimage.data import astronaut

        Image.fromarray(astronaut()).save(tmp_path / "a.png")
        said = command("bench", "light", "--symmetry", tmp_path)
        assert said.code == 0, said.err
        assert "light by the face alone" in said.out
        assert len(said.out.splitlines()) == 1 + 4
