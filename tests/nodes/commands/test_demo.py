"""`graphface demo`: one photograph under three scenes, a row of them, and a sheet of every stage."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from graphface.nodes.commands.demo import SCENES
from graphface.nodes.io.image_read import read_image
from graphface.nodes.io.image_write import write_picture


class TestDemo:
    def test_pictures(self, command, face, tmp_path):
        """A picture for each scene at the photo's size; the row shows the photo and each scene; all are different."""
        write_picture(face, tmp_path / "me.png")
        said = command("demo", tmp_path / "out", "--photo", tmp_path / "me.png")
        assert said.code == 0, said.err
        made = {path.name: read_image(path).pixels for path in (tmp_path / "out").iterdir()}
        assert set(made) == {*(f"{scene}.png" for scene in SCENES), "demo.jpg", "contact-sheet.png"}
        assert all(made[f"{scene}.png"].shape == face.shape for scene in SCENES)
        row = made["demo.jpg"]
        cells = np.split(row, 1 + len(SCENES), axis=1)
        assert all(np.abs(a - b).mean() > 0.01 for a, b in pairwise(cells))
        assert made["contact-sheet.png"].shape[1] == 4 * (360 + 4)

    def test_missing_photo(self, command, tmp_path):
        """A photo that does not exist is named."""
        said = command("demo", tmp_path / "out", "--photo", tmp_path / "none.png")
        assert said.code == 2
        assert "none.png" in said.err
