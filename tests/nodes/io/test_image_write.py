"""Images to picture files: what is written is read again, and a failure leaves nothing behind."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import PIL.Image as Pillow
import pytest
from pictures import EXIF_DIRECTORY, EXPOSURE, ICC, LOSSLESS, MAKE, SUFFIXES, exif_block, smooth

from graphface import GraphfaceWarning, UnwritableFile
from graphface.nodes.color import decode_srgb
from graphface.nodes.io.image_read import read_image
from graphface.nodes.io.image_write import write_image, write_picture
from graphface.nodes.types import FileFormat, Image


class TestRoundTrip:
    @pytest.mark.parametrize("suffix", SUFFIXES)
    @pytest.mark.parametrize("bits", [8, 16])
    @pytest.mark.parametrize("grey", [False, True])
    def test_pixels(self, tmp_path, suffix, bits, grey):
        """Written and read again, pixels differ by half a step; in JPEG and WebP by more, most in WebP's colors."""
        pixels = np.repeat(smooth(channels=1), 3, axis=2) if grey else smooth()
        write_image(Image(pixels, file=FileFormat(bits=bits, grey=grey)), tmp_path / f"a{suffix}")
        back = read_image(tmp_path / f"a{suffix}")
        deep = bits == 16 and suffix in LOSSLESS
        tolerance = 0.51 / (65535 if deep else 255) if suffix in LOSSLESS else 20 / 255
        assert np.abs(back.pixels - pixels).max() <= tolerance
        assert back.file.bits == (16 if deep else 8)

    @pytest.mark.parametrize("suffix", LOSSLESS)
    @pytest.mark.parametrize("bits", [8, 16])
    def test_writing_what_was_read_changes_nothing(self, tmp_path, suffix, bits):
        """Reading and writing again gives the same samples: no drift over generations."""
        write_image(Image(smooth(), file=FileFormat(bits=bits)), tmp_path / f"a{suffix}")
        first = read_image(tmp_path / f"a{suffix}")
        write_image(first, tmp_path / f"b{suffix}")
        np.testing.assert_array_equal(read_image(tmp_path / f"b{suffix}").pixels, first.pixels)

    @pytest.mark.parametrize("suffix", [".png", ".webp", ".tif"])
    @pytest.mark.parametrize("bits", [8, 16])
    def test_alpha_is_kept(self, tmp_path, suffix, bits):
        """Transparency is written and read again, not multiplied into the colors."""
        alpha = smooth(channels=1)[..., 0]
        write_image(Image(smooth(), alpha, file=FileFormat(bits=bits)), tmp_path / f"a{suffix}")
        back = read_image(tmp_path / f"a{suffix}")
        assert back.alpha is not None
        assert np.abs(back.alpha - alpha).max() <= 0.51 / 255
        if suffix in LOSSLESS:
            assert np.abs(back.pixels - smooth()).max() <= 0.51 / 255

    def test_alpha_lost_to_jpeg_warns(self, tmp_path):
        """JPEG has no transparency: written without, and warned about."""
        with pytest.warns(GraphfaceWarning, match="no transparency"):
            write_image(Image(smooth(), np.ones((40, 60), np.float32)), tmp_path / "a.jpg")
        assert read_image(tmp_path / "a.jpg").alpha is None

    @pytest.mark.parametrize("suffix", SUFFIXES)
    @pytest.mark.parametrize("bits", [8, 16])
    def test_profile_and_exif_are_kept(self, tmp_path, suffix, bits):
        """ICC profile and EXIF come through every format."""
        file = FileFormat(bits=bits, icc=ICC, exif=exif_block())
        write_image(Image(smooth(), file=file), tmp_path / f"a{suffix}")
        back = read_image(tmp_path / f"a{suffix}").file
        exif = Pillow.Exif()
        exif.load(back.exif)
        assert back.icc == ICC
        assert exif[MAKE] == "Maker"
        assert (
            tuple(exif.get_ifd(EXIF_DIRECTORY)[EXPOSURE]) == (1, 60) or exif.get_ifd(EXIF_DIRECTORY)[EXPOSURE] == 1 / 60
        )

    @pytest.mark.parametrize("suffix", SUFFIXES)
    def test_others_can_read_it(self, tmp_path, suffix):
        """Pillow, another reader, sees the picture and its profile."""
        write_image(Image(smooth(), file=FileFormat(icc=ICC)), tmp_path / f"a{suffix}")
        with Pillow.open(tmp_path / f"a{suffix}") as picture:
            picture.load()
            assert picture.size == (60, 40)
            assert picture.info["icc_profile"] == ICC

    @pytest.mark.parametrize("suffix", [".png", ".jpg", ".tif"])
    def test_grey_stays_grey(self, tmp_path, suffix):
        """A grey photo is written with one channel as long as it is grey."""
        write_image(
            Image(np.repeat(smooth(channels=1), 3, axis=2), file=FileFormat(grey=True)), tmp_path / f"a{suffix}"
        )
        assert read_image(tmp_path / f"a{suffix}").file.grey

    def test_grey_photo_under_colored_light_gets_color(self, tmp_path):
        """A grey photo that has been given color is written in color."""
        write_image(Image(smooth(), file=FileFormat(grey=True)), tmp_path / "a.png")
        assert not read_image(tmp_path / "a.png").file.grey

    def test_grey_profile_is_not_put_on_color(self, tmp_path):
        """A profile for grey does not fit RGB samples: it is left out, with a warning."""
        icc = ICC[:16] + b"GRAY" + ICC[20:]
        with pytest.warns(GraphfaceWarning, match="profile"):
            write_image(Image(smooth(), file=FileFormat(grey=True, icc=icc)), tmp_path / "a.png")
        assert read_image(tmp_path / "a.png").file.icc is None

    def test_linear_light_is_encoded(self, tmp_path):
        """Files hold sRGB, whatever the encoding in memory."""
        write_image(Image(decode_srgb(smooth()), encoding="linear"), tmp_path / "a.png")
        assert np.abs(read_image(tmp_path / "a.png").pixels - smooth()).max() <= 0.51 / 255

    def test_values_outside_are_clipped(self, tmp_path):
        """Highlights above 1 become white and values below 0 black; nothing wraps around."""
        pixels = np.array([[[-3, -0.001, 0], [1, 1.001, 300]]], np.float32)
        write_image(Image(pixels), tmp_path / "a.png")
        np.testing.assert_array_equal(read_image(tmp_path / "a.png").pixels, [[[0, 0, 0], [1, 1, 1]]])

    @pytest.mark.parametrize("suffix", SUFFIXES)
    def test_one_pixel(self, tmp_path, suffix):
        """A picture of one pixel is a picture."""
        write_image(Image(np.full((1, 1, 3), 0.5, np.float32)), tmp_path / f"a{suffix}")
        assert read_image(tmp_path / f"a{suffix}").pixels.shape == (1, 1, 3)


class TestUnwritable:
    @pytest.mark.parametrize("name", ["a.gif", "a", "a.png.bak"])
    def test_unknown_suffix(self, tmp_path, name):
        """An unknown suffix is answered with the known ones."""
        with pytest.raises(UnwritableFile, match=r"\.png, \.jpg"):
            write_image(Image(smooth()), tmp_path / name)

    def test_missing_folder(self, tmp_path):
        """A folder that does not exist is named."""
        with pytest.raises(UnwritableFile, match="does not exist"):
            write_image(Image(smooth()), tmp_path / "none" / "a.png")

    def test_link(self, tmp_path):
        """A symbolic link stays; what it points to is the picture."""
        (tmp_path / "link.png").symlink_to(tmp_path / "target.png")
        write_image(Image(smooth()), tmp_path / "link.png")
        assert (tmp_path / "link.png").is_symlink()
        assert (tmp_path / "target.png").stat().st_size > 100

    def test_read_only_folder(self, tmp_path, monkeypatch):
        """A folder that may not be written to is named, and nothing is left in it."""

        def refuse(self: Path, *_: object, **__: object) -> None:
            raise PermissionError(13, "Permission denied")

        monkeypatch.setattr(Path, "open", refuse)  # tests may run as root, whom no folder refuses
        with pytest.raises(UnwritableFile, match="may not be written to"):
            write_image(Image(smooth()), tmp_path / "a.png")
        assert list(tmp_path.iterdir()) == []

    def test_failure_leaves_the_old_file(self, tmp_path, monkeypatch):
        """When the last step fails the file that was there is untouched, and no part is left beside it."""
        (tmp_path / "a.png").write_bytes(b"old")

        def full(*_: object) -> None:
            raise OSError(28, "No space left on device")

        monkeypatch.setattr("os.replace", full)
        with pytest.raises(UnwritableFile, match="No space left"):
            write_image(Image(smooth()), tmp_path / "a.png")
        assert [p.read_bytes() for p in tmp_path.iterdir()] == [b"old"]

    def test_nan(self, tmp_path):
        """Pixels that are not numbers are never written."""
        with pytest.raises(UnwritableFile, match="not numbers"):
            write_image(Image(np.full((2, 2, 3), np.nan, np.float32)), tmp_path / "a.png")

    def test_too_large_for_webp(self, tmp_path):
        """WebP ends at 16383 pixels."""
        with pytest.raises(UnwritableFile, match="too many for WEBP"):
            write_image(Image(np.zeros((1, 17000, 3), np.float32)), tmp_path / "a.webp")


class TestWritePicture:
    @pytest.mark.parametrize("shape", [(5, 7), (5, 7, 3), (5, 7, 4)])
    def test_bytes_are_written_as_they_are(self, tmp_path, shape):
        """A uint8 picture comes back byte for byte."""
        pixels = np.arange(np.prod(shape), dtype=np.uint8).reshape(shape)
        write_picture(pixels, tmp_path / "a.png")
        np.testing.assert_array_equal(np.asarray(Pillow.open(tmp_path / "a.png")), pixels)

    def test_other_arrays_are_refused(self, tmp_path):
        """Floats are no picture bytes."""
        with pytest.raises(ValueError, match="expected uint8"):
            write_picture(smooth(), tmp_path / "a.png")
