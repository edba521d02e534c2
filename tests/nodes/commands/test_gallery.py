"""`graphface gallery`: every photo under every scene, and a sheet of each photo."""

from __future__ import annotations

import numpy as np
import pytest

from graphface.nodes.io.image_read import read_image
from graphface.nodes.io.image_write import write_picture

OWN = "mode: add\n"
LEFT = "ambient: 0.3\nbackground: 1\nhair: 0\nlights: [{type: directional, azimuth: -60, shadow: none}]\n"
RIGHT = LEFT.replace("-60", "60")


@pytest.fixture
def scenes(tmp_path):
    """Options that name three scene files: the photo's own light, light from the left, light from the right."""
    options = []
    for name, text in (("own", OWN), ("left", LEFT), ("right", RIGHT)):
        (tmp_path / f"{name}.yaml").write_text(text)
        options += ["--scene", tmp_path / f"{name}.yaml"]
    return options


@pytest.fixture
def photo(face, tmp_path):
    write_picture(face, tmp_path / "me.png")
    return tmp_path / "me.png"


class TestGallery:
    def test_every_photo_under_every_scene(self, command, face, photo, scenes, tmp_path):
        """PHOTO-SCENE.png at the photo's size; PHOTO-sheet.png with the photo first, in rows of `--columns`."""
        write_picture(face[:, ::-1].copy(), tmp_path / "mirrored.png")
        out = tmp_path / "made/gallery"
        said = command("gallery", out, "--photo", photo, "--photo", tmp_path / "mirrored.png", *scenes, "--columns", 2)
        assert said.code == 0, said.err
        assert "6 pictures and 2 sheets" in said.out
        expected = {f"{p}-{s}.png" for p in ("me", "mirrored") for s in ("own", "left", "right", "sheet")}
        assert {p.name for p in out.iterdir()} == expected
        own, left, right = (read_image(out / f"me-{name}.png").pixels for name in ("own", "left", "right"))
        np.testing.assert_array_equal(np.rint(own * 255), face)
        change = (left - right).mean(axis=2)[40:80]
        assert change[:, 42:60].mean() > 0.05
        assert change[:, 68:86].mean() < -0.05
        sheet = read_image(out / "me-sheet.png")
        assert sheet.width == 2 * (300 + 4)  # two columns, each with its margin
        assert sheet.height > 2 * 300  # two rows of square pictures under their captions

    def test_profile(self, command, photo, tmp_path):
        """A profile of the relight graph changes what is made; one that it does not have is told the nearest."""
        (tmp_path / "soft.yaml").write_text("lights: [{type: directional, azimuth: -50, size: 10, shadow: soft}]\n")
        pictures = []
        for name, more in (("full", ()), ("quick", ("--profile", "draft"))):
            said = command("gallery", tmp_path / name, "--photo", photo, "--scene", tmp_path / "soft.yaml", *more)
            assert said.code == 0, said.err
            pictures.append(read_image(tmp_path / name / "me-soft.png").pixels)
        assert 0 < np.abs(pictures[0] - pictures[1]).mean() < 0.02
        said = command("gallery", tmp_path / "x", "--photo", photo, "--profile", "darft")
        assert said.code == 2
        assert "'draft'" in said.err

    def test_photos_of_one_name(self, command, tmp_path):
        """Two photos whose pictures would overwrite each other are refused before anything is made."""
        said = command("gallery", tmp_path / "out", "--photo", tmp_path / "a/me.png", "--photo", tmp_path / "b/me.jpg")
        assert said.code == 2
        assert "overwrite" in said.err
        assert not (tmp_path / "out").exists()

    def test_missing_photo(self, command, tmp_path):
        """A photo that does not exist is named."""
        said = command("gallery", tmp_path / "out", "--photo", tmp_path / "none.png")
        assert said.code == 2
        assert "none.png" in said.err

    def test_folder_that_cannot_be(self, command, tmp_path):
        """A file in the place of the folder is named."""
        (tmp_path / "taken").write_text("")
        said = command("gallery", tmp_path / "taken")
        assert said.code == 2
        assert "taken" in said.err
