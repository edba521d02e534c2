"""`graphface bench scenes`: a line for each scene."""

from __future__ import annotations

from graphface.nodes.bench import scene_cost
from graphface.nodes.io.image_write import write_picture


class TestBenchScenes:
    def test_table(self, command, face, tmp_path, monkeypatch):
        """One line for each, with nodes, effects, milliseconds and copies."""
        (tmp_path / "own.yaml").write_text("mode: add\n")
        monkeypatch.setattr(scene_cost, "shipped_scenes", lambda: [tmp_path / "own.yaml"])
        write_picture(face, tmp_path / "me.png")
        said = command("bench", "scenes", "--photo", tmp_path / "me.png", "--megapixels", 0.0164, "--repeats", 1)
        assert said.code == 0, said.err
        assert len(said.out.splitlines()) == 1 + len(scene_cost.PLAIN) + 1
        nodes, *effects, milliseconds, spent, copies = said.figures("soft-shadowed spot")
        assert int(nodes) > 3
        assert "shadows," in effects
        assert float(milliseconds) > 0
        assert float(spent) > 0
        assert float(copies) > 0

    def test_missing_photo(self, command, tmp_path):
        """A photo that does not exist is named."""
        said = command("bench", "scenes", "--photo", tmp_path / "none.png")
        assert said.code == 2
        assert "none.png" in said.err
