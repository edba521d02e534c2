"""Picture files to images: every kind is read, and damage is refused."""

from __future__ import annotations

import struct
import warnings
import zlib
from pathlib import Path

import cv2
import numpy as np
import PIL.Image as Pillow
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pictures import ICC, MAKE, ORIENTATION, SUFFIXES, exif_block, smooth

from graphface import GraphfaceWarning, UnreadableFile
from graphface.nodes.io.image_read import _upright, read_image
from graphface.nodes.io.image_write import write_image
from graphface.nodes.types import FileFormat, Image

CASES = Path(__file__).parents[4] / "shared" / "cases"


class TestOrientation:
    @pytest.mark.parametrize("orientation", range(1, 9))
    @pytest.mark.parametrize("suffix", [".jpg", ".png", ".webp", ".tif"])
    def test_agrees_with_pillow(self, tmp_path, orientation, suffix):
        """All eight orientations come out upright, as Pillow turns them."""
        from PIL import ImageOps

        picture = Pillow.fromarray((smooth(24, 40) * 255).astype(np.uint8))
        picture.save(tmp_path / f"a{suffix}", exif=exif_block(_274=orientation))
        with Pillow.open(tmp_path / f"a{suffix}") as stored:
            expected = np.asarray(ImageOps.exif_transpose(stored).convert("RGB"), np.float32) / 255
        np.testing.assert_allclose(read_image(tmp_path / f"a{suffix}").pixels, expected, atol=1e-6)

    @pytest.mark.parametrize("orientation", range(1, 9))
    def test_sixteen_bit_tiff(self, tmp_path, orientation):
        """OpenCV, which decodes these, does not turn them a second time."""
        plain, turned = tmp_path / "a.tif", tmp_path / "b.tif"
        for path, exif in ((plain, None), (turned, exif_block(_274=orientation))):
            write_image(Image(smooth(24, 40), file=FileFormat(bits=16, exif=exif)), path)
        expected = _upright(read_image(plain).pixels, orientation)
        np.testing.assert_array_equal(read_image(turned).pixels, expected)

    def test_tag_is_reset(self, tmp_path):
        """Once applied the orientation is gone from the EXIF, or the next viewer would turn the picture again."""
        Pillow.fromarray((smooth() * 255).astype(np.uint8)).save(tmp_path / "a.jpg", exif=exif_block(_274=6))
        exif = Pillow.Exif()
        exif.load(read_image(tmp_path / "a.jpg").file.exif)
        assert ORIENTATION not in exif
        assert exif[MAKE] == "Maker"


class TestKinds:
    """Every kind of file that cameras, phones and editors write."""

    @pytest.mark.parametrize(
        ("mode", "suffix", "alpha", "grey"),
        [
            ("1", ".png", False, True),
            ("L", ".png", False, True),
            ("LA", ".png", True, True),
            ("P", ".png", False, False),
            ("RGBA", ".png", True, False),
            ("I;16", ".png", False, True),
            ("CMYK", ".jpg", False, False),
            ("CMYK", ".tif", False, False),
            ("L", ".tif", False, True),
            ("LA", ".tif", True, True),
            ("YCbCr", ".jpg", False, False),
            ("RGBA", ".webp", True, False),
        ],
    )
    def test_mode(self, tmp_path, mode, suffix, alpha, grey):
        """Any color mode becomes float32 RGB in 0..1, with the alpha apart."""
        base = Pillow.fromarray((smooth(channels=4) * 255).astype(np.uint8), "RGBA")
        if mode == "I;16":
            picture = Pillow.fromarray((smooth(channels=1)[..., 0] * 65535).astype(np.uint16))
        else:
            picture = (base if mode == "RGBA" else base.convert("RGB")).convert(mode)
        picture.save(tmp_path / f"a{suffix}")
        image = read_image(tmp_path / f"a{suffix}")
        assert image.pixels.dtype == np.float32
        assert image.pixels.shape == (40, 60, 3)
        assert 0 <= image.pixels.min() < 0.35
        assert 0.65 < image.pixels.max() <= 1
        assert (image.alpha is not None, image.file.grey) == (alpha, grey)

    def test_palette_with_transparency(self, tmp_path):
        """A transparent palette entry becomes alpha."""
        picture = Pillow.new("P", (8, 8))
        picture.putpalette([255, 0, 0, 0, 255, 0])
        picture.putpixel((0, 0), 1)
        picture.save(tmp_path / "a.png", transparency=1)
        image = read_image(tmp_path / "a.png")
        assert image.alpha is not None
        assert (image.alpha[0, 0], image.alpha[1, 1]) == (0, 1)
        np.testing.assert_array_equal(image.pixels[1, 1], [1, 0, 0])

    @pytest.mark.parametrize("suffix", [".png", ".tif"])
    @pytest.mark.parametrize("channels", [3, 4])
    def test_sixteen_bit_color_is_not_halved(self, tmp_path, suffix, channels):
        """All 16 bits of each channel arrive, in RGB order."""
        samples = np.arange(4 * 5 * channels, dtype=np.uint16).reshape(4, 5, channels) * 257 + 1
        order = [2, 1, 0, 3][:channels]
        cv2.imwrite(str(tmp_path / f"a{suffix}"), samples[..., order])
        image = read_image(tmp_path / f"a{suffix}")
        np.testing.assert_allclose(image.pixels * 65535, samples[..., :3], atol=0.01)
        assert image.file.bits == 16
        if channels == 4:
            np.testing.assert_allclose(image.alpha * 65535, samples[..., 3], atol=0.01)

    def test_floating_tiff(self, tmp_path):
        """Floating-point values pass as they are, above 1 too."""
        samples = smooth() * 3
        cv2.imwrite(str(tmp_path / "a.tif"), samples[..., ::-1])
        np.testing.assert_allclose(read_image(tmp_path / "a.tif").pixels, samples, atol=1e-6)

    @pytest.mark.parametrize("suffix", [".png", ".webp"])
    def test_first_frame_of_an_animation(self, tmp_path, suffix):
        """Of an animation the first frame is read, with a warning."""
        frames = [Pillow.new("RGB", (8, 8), color) for color in ("red", "blue")]
        frames[0].save(tmp_path / f"a{suffix}", save_all=True, append_images=frames[1:], lossless=True)
        with pytest.warns(GraphfaceWarning, match="2 pictures"):
            pixels = read_image(tmp_path / f"a{suffix}").pixels
        np.testing.assert_allclose(pixels[0, 0], [1, 0, 0], atol=0.02)

    def test_suffix_does_not_matter(self, tmp_path):
        """The format is that of the content, not of the name."""
        Pillow.new("RGB", (8, 8)).save(tmp_path / "a.jpg", "PNG")
        assert read_image(tmp_path / "a.jpg").file.name == "PNG"

    def test_profile_of_inks_is_not_kept(self, tmp_path):
        """A CMYK file's profile does not fit the RGB that it became."""
        Pillow.new("CMYK", (8, 8), (0, 255, 255, 0)).save(tmp_path / "a.jpg", icc_profile=b"x" * 200)
        with pytest.warns(GraphfaceWarning, match="CMYK profile is damaged"):
            image = read_image(tmp_path / "a.jpg")
        assert image.file.icc is None
        assert image.pixels[0, 0, 0] > 0.8 > 0.2 > image.pixels[0, 0, 2]


class TestDamagedExif:
    @pytest.mark.filterwarnings("ignore:Corrupt EXIF data")
    @pytest.mark.parametrize("damage", ["", "49492a00", "49492a00ff", "ffffffff00000008", "4d4d002a000000080002"])
    def test_pixels_are_good(self, tmp_path, damage):
        """A picture whose EXIF is damaged is read without it, with a warning."""
        Pillow.new("RGB", (8, 8), "red").save(tmp_path / "a.jpg", exif=b"Exif\0\0" + bytes.fromhex(damage), quality=95)
        with warnings.catch_warnings(record=True) as said:
            warnings.simplefilter("always")
            image = read_image(tmp_path / "a.jpg")
        assert image.pixels[0, 0, 0] > 0.9
        assert image.file.exif is None
        assert not damage or any("EXIF" in str(one.message) for one in said)

    @pytest.mark.filterwarnings("ignore")
    @pytest.mark.skipif(not CASES.is_dir(), reason="needs ../shared/cases")
    @pytest.mark.parametrize("name", ["bad_header.jpg", "cut_entry.jpg", "cut_header.jpg"])
    def test_cases(self, name):
        """Files that were refused."""
        assert read_image(CASES / "truncated_exif" / name).pixels.shape == (512, 512, 3)


class TestUnreadable:
    @pytest.mark.filterwarnings("ignore:Corrupt EXIF data")
    @pytest.mark.parametrize(
        ("content", "reason"),
        [
            (b"", "is empty"),
            (b"this is a text file\n" * 20, "not a PNG, JPEG, WebP or TIFF"),
            (b"GIF89a" + bytes(100), "not a PNG, JPEG, WebP or TIFF"),
            (b"\x89PNG\r\n\x1a\n", "damaged"),
            (b"\xff\xd8\xff", "damaged"),
            (b"RIFF\0\0\0\0WEBP", "damaged"),
            (b"II*\0\xff\xff\xff\x7f", "damaged"),
        ],
    )
    def test_no_picture(self, tmp_path, content, reason):
        """What is no picture is refused with the reason in one line."""
        (tmp_path / "a.jpg").write_bytes(content)
        with pytest.raises(UnreadableFile, match=reason) as caught:
            read_image(tmp_path / "a.jpg")
        assert "\n" not in str(caught.value)

    @pytest.mark.parametrize("suffix", SUFFIXES)
    @pytest.mark.parametrize("bits", [8, 16])
    @pytest.mark.parametrize("kept", [0.05, 0.5, 0.9])
    def test_cut_off(self, tmp_path, suffix, bits, kept):
        """Half a file is refused, not filled up with grey."""
        rng = np.random.default_rng(0)
        path = tmp_path / f"a{suffix}"
        write_image(Image(rng.random((64, 64, 3), np.float32), file=FileFormat(bits=bits)), path)
        content = path.read_bytes()
        path.write_bytes(content[: int(len(content) * kept)])
        with pytest.raises(UnreadableFile):
            read_image(path)

    @pytest.mark.filterwarnings("ignore::UserWarning")  # Pillow's own, about what it skips
    @settings(max_examples=60, deadline=None)
    @given(data=st.data(), suffix=st.sampled_from(SUFFIXES), bits=st.sampled_from([8, 16]))
    def test_any_damage_is_a_picture_or_an_error(self, tmp_path_factory, data, suffix, bits):
        """Flipped bytes anywhere give finite pixels or UnreadableFile, nothing else."""
        path = tmp_path_factory.mktemp("damage") / f"a{suffix}"
        write_image(Image(smooth(8, 8), file=FileFormat(bits=bits, icc=ICC, exif=exif_block())), path)
        content = bytearray(path.read_bytes())
        for _ in range(data.draw(st.integers(1, 4))):
            content[data.draw(st.integers(0, len(content) - 1))] = data.draw(st.integers(0, 255))
        path.write_bytes(content)
        try:
            image = read_image(path)
        except UnreadableFile:
            return
        assert np.isfinite(image.pixels).all()

    def test_folder(self, tmp_path):
        """A folder is not a picture."""
        with pytest.raises(UnreadableFile, match="folder"):
            read_image(tmp_path)

    def test_missing(self, tmp_path):
        """A file that is not there is named."""
        with pytest.raises(UnreadableFile, match="no such file"):
            read_image(tmp_path / "a.png")

    def test_header_bomb(self, tmp_path):
        """A header that claims 900 megapixels is refused before anything is decoded."""
        header = struct.pack(">IIBBBBB", 30000, 30000, 8, 2, 0, 0, 0)
        chunk = b"IHDR" + header
        bomb = b"\x89PNG\r\n\x1a\n" + struct.pack(">I", 13) + chunk + struct.pack(">I", zlib.crc32(chunk))
        bomb += struct.pack(">I", 8) + b"IDAT" + bytes(12)
        (tmp_path / "a.png").write_bytes(bomb)
        with pytest.raises(UnreadableFile, match="30000 x 30000 pixels, more than 200 million"):
            read_image(tmp_path / "a.png")

    def test_limit_is_settable(self, tmp_path, monkeypatch):
        """GRAPHFACE_MAX_PIXELS moves the limit."""
        write_image(Image(smooth()), tmp_path / "a.png")
        monkeypatch.setenv("GRAPHFACE_MAX_PIXELS", "2000")
        with pytest.raises(UnreadableFile, match="GRAPHFACE_MAX_PIXELS"):
            read_image(tmp_path / "a.png")

    def test_nan(self, tmp_path):
        """A TIFF with NaN is refused."""
        samples = smooth()
        samples[3, 3] = np.nan
        cv2.imwrite(str(tmp_path / "a.tif"), samples)
        with pytest.raises(UnreadableFile, match="not numbers"):
            read_image(tmp_path / "a.tif")
