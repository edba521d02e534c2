"""Files of environment maps."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from graphface import UnreadableFile
from graphface.nodes.io.exr import write_exr
from graphface.nodes.io.image_write import write_picture
from graphface.nodes.io.panorama import read_panorama, write_panorama
from graphface.nodes.types import Environment

BOMBS = Path(__file__).parents[4] / "shared" / "cases" / "bombs"


@pytest.fixture
def panorama(rng):
    return Environment((rng.random((9, 18, 3)) * 20).astype(np.float32))


class TestEnvironmentFiles:
    def test_exr_is_exact(self, panorama, tmp_path):
        """Floats go through OpenEXR unchanged."""
        write_panorama(panorama, tmp_path / "sky.exr")
        np.testing.assert_array_equal(read_panorama(tmp_path / "sky.exr").radiance, panorama.radiance)

    def test_hdr_is_near(self, panorama, tmp_path):
        """Radiance HDR keeps a shared exponent: one percent of the brightest channel."""
        write_panorama(panorama, tmp_path / "sky.hdr")
        again = read_panorama(tmp_path / "sky.hdr").radiance
        np.testing.assert_allclose(again, panorama.radiance, atol=0.01 * panorama.radiance.max())

    def test_holes_and_negatives_become_dark(self, tmp_path):
        """Radiance is finite and not negative, whatever the file contains."""
        write_exr(np.full((2, 4, 3), -1, np.float32) * np.float32([1, np.nan, -2]), tmp_path / "sky.exr")
        np.testing.assert_array_equal(read_panorama(tmp_path / "sky.exr").radiance[0, 0], [0, 0, 2])

    @pytest.mark.parametrize("name", ["sky.exr", "sky.hdr"])
    def test_missing_and_foreign_files(self, name, tmp_path):
        """The error is one of ours, and names the file."""
        with pytest.raises(UnreadableFile, match=name):
            read_panorama(tmp_path / name)
        (tmp_path / name).write_bytes(b"not a picture")
        with pytest.raises(UnreadableFile, match=name):
            read_panorama(tmp_path / name)

    @pytest.mark.parametrize("name", ["sky.exr", "sky.hdr", "sky.pic", "sky.png"])
    def test_size_is_limited(self, name, panorama, tmp_path, monkeypatch):
        """As that of any picture, before anything is decoded."""
        write_panorama(panorama, tmp_path / name)
        monkeypatch.setenv("GRAPHFACE_MAX_PIXELS", "100")
        with pytest.raises(UnreadableFile, match=rf"{name}: claims 18 x 9 pixels"):
            read_panorama(tmp_path / name)

    def test_damaged_hdr(self, panorama, tmp_path):
        """A header without pixels is an error of ours."""
        (tmp_path / "sky.hdr").write_bytes(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 30 +X 30\n\2\2")
        with pytest.raises(UnreadableFile, match=r"sky\.hdr"):
            read_panorama(tmp_path / "sky.hdr")

    @pytest.mark.skipif(not BOMBS.is_dir(), reason="needs ../shared/cases")
    @pytest.mark.parametrize("name", ["bomb.hdr", "bomb.webp"])
    def test_bombs(self, name):
        """Files of a few bytes that ask for gigabytes."""
        with pytest.raises(UnreadableFile, match="pixels"):
            read_panorama(BOMBS / name)

    @pytest.mark.skipif(not BOMBS.is_dir(), reason="needs ../shared/cases")
    def test_a_long_line(self, monkeypatch):
        """One line of 16 million pixels takes no more than it says."""
        monkeypatch.setenv("GRAPHFACE_MAX_PICTURE_MEMORY", "500M")
        with pytest.raises(UnreadableFile, match="GB of memory"):
            read_panorama(BOMBS / "bomb.exr")

    def test_any_picture_is_decoded(self, tmp_path):
        """An 8-bit picture has radiance in 0..1, linear."""
        write_picture(np.full((4, 8, 3), 128, np.uint8), tmp_path / "sky.png")
        np.testing.assert_allclose(read_panorama(tmp_path / "sky.png").radiance, 0.2159, atol=1e-3)

    @pytest.mark.parametrize("mean", [0.1, 5.0])
    def test_written_as_a_picture(self, mean, tmp_path):
        """As a picture it is sRGB-encoded; what is brighter than a picture can show has its mean at mid grey."""
        write_panorama(Environment(np.full((4, 8, 3), mean, np.float32)), tmp_path / "sky.png")
        read = read_panorama(tmp_path / "sky.png").radiance
        assert read == pytest.approx(min(mean, 0.25), abs=0.003)
