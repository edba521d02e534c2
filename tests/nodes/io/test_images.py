"""Pictures in and out: what is kept, what is refused, and in which words."""

import io
import struct
import zlib
from pathlib import Path

import cv2
import numpy as np
import PIL.Image as Pillow
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from PIL import ImageCms

from graphface import GraphfaceWarning, UnreadableFile, UnwritableFile
from graphface.nodes.color import decode_srgb
from graphface.nodes.image.encode import encode
from graphface.nodes.image.resize import resize
from graphface.nodes.io.image_read import _upright, read_image
from graphface.nodes.io.image_text import read_text
from graphface.nodes.io.image_write import write_image, write_picture
from graphface.nodes.types import FileFormat, Image
from graphface.nodes.types.image import image_from_array

SUFFIXES = [".png", ".jpg", ".webp", ".tif"]
LOSSLESS = [".png", ".tif"]
ICC = ImageCms.ImageCmsProfile(ImageCms.createProfile("sRGB")).tobytes()
WORDS = {"run": 'graph: é\n  x: "<&>\'"\n', "version": "1"}
MAKE, ORIENTATION, EXPOSURE, EXIF_DIRECTORY = 271, 274, 33434, 0x8769


def smooth(height: int = 40, width: int = 60, channels: int = 3) -> np.ndarray:
    """A picture without hard edges, float32 in 0..1, another ramp in every channel."""
    y, x = np.mgrid[0 : 1 : height * 1j, 0 : 1 : width * 1j]
    ramps = [x, y, 1 - x * y, (x + y) / 2]
    return np.stack(ramps[:channels], axis=-1).astype(np.float32)


def exif_block(**tags: int) -> bytes:
    exif = Pillow.Exif()
    exif[MAKE] = "Maker"
    for tag, value in tags.items():
        exif[int(tag.strip("_"))] = value
    exif.get_ifd(EXIF_DIRECTORY)[EXPOSURE] = (1, 60)
    return exif.tobytes()


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

    def test_alpha_lost_to_jpeg_is_said(self, tmp_path):
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
        """A profile for grey does not fit RGB samples: left out, and said."""
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
        """Of an animation the first frame is read, and said."""
        frames = [Pillow.new("RGB", (8, 8), color) for color in ("red", "blue")]
        frames[0].save(tmp_path / f"a{suffix}", save_all=True, append_images=frames[1:], lossless=True)
        with pytest.warns(GraphfaceWarning, match="2 pictures"):
            pixels = read_image(tmp_path / f"a{suffix}").pixels
        np.testing.assert_allclose(pixels[0, 0], [1, 0, 0], atol=0.02)

    def test_suffix_does_not_matter(self, tmp_path):
        """The content says what a file is, not its name."""
        Pillow.new("RGB", (8, 8)).save(tmp_path / "a.jpg", "PNG")
        assert read_image(tmp_path / "a.jpg").file.name == "PNG"

    def test_profile_of_inks_is_not_kept(self, tmp_path):
        """A CMYK file's profile does not fit the RGB that it became."""
        Pillow.new("CMYK", (8, 8), (0, 255, 255, 0)).save(tmp_path / "a.jpg", icc_profile=b"x" * 200)
        with pytest.warns(GraphfaceWarning, match="CMYK profile is damaged"):
            image = read_image(tmp_path / "a.jpg")
        assert image.file.icc is None
        assert image.pixels[0, 0, 0] > 0.8 > 0.2 > image.pixels[0, 0, 2]


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


class TestText:
    @pytest.mark.parametrize("suffix", SUFFIXES)
    @pytest.mark.parametrize("bits", [8, 16])
    def test_comes_back(self, tmp_path, suffix, bits):
        """Words put into a picture are found again, exactly, beside the EXIF that was there."""
        file = FileFormat(bits=bits, exif=exif_block())
        write_image(Image(smooth(), file=file), tmp_path / f"a{suffix}", text=WORDS)
        assert read_text(tmp_path / f"a{suffix}") == WORDS
        assert read_image(tmp_path / f"a{suffix}").file.exif is not None

    @pytest.mark.parametrize("suffix", SUFFIXES)
    def test_long(self, tmp_path, suffix):
        """A long graph fits into every format, compressed where it must."""
        words = {"run": "  node: {use: render.shade}\n" * 20_000}
        write_image(Image(smooth()), tmp_path / f"a{suffix}", text=words)
        assert read_text(tmp_path / f"a{suffix}") == words

    def test_none(self, tmp_path):
        """A picture without words has none."""
        write_image(Image(smooth()), tmp_path / "a.jpg")
        assert read_text(tmp_path / "a.jpg") == {}

    def test_damaged(self, tmp_path):
        """Words that are no longer readable are an error, not a guess."""
        out = io.BytesIO()
        Pillow.new("RGB", (4, 4)).save(out, "JPEG", xmp=b'graphface:text="{broken"')
        (tmp_path / "a.jpg").write_bytes(out.getvalue())
        with pytest.raises(UnreadableFile, match="text inside is damaged"):
            read_text(tmp_path / "a.jpg")


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


class TestFromArray:
    @pytest.mark.parametrize(("dtype", "top"), [(np.uint8, 255), (np.uint16, 65535), (np.float64, 1), (np.bool_, 1)])
    @pytest.mark.parametrize("shape", [(4, 5), (4, 5, 1), (4, 5, 3), (4, 5, 4)])
    def test_kinds(self, dtype, top, shape):
        """Every usual dtype and shape becomes float32 RGB with 1 as the brightest."""
        image = image_from_array(np.full(shape, top, dtype))
        assert image.pixels.shape == (4, 5, 3)
        assert image.pixels.dtype == np.float32
        assert image.pixels.min() == image.pixels.max() == 1
        assert (image.alpha is not None) == (len(shape) == 3 and shape[2] == 4)

    @pytest.mark.parametrize(
        ("value", "words"),
        [
            (np.zeros((4, 5, 2)), r"\(4, 5, 2\)"),
            (np.zeros(7), r"\(7,\)"),
            (np.zeros((0, 5, 3)), r"\(0, 5, 3\)"),
            (np.zeros((4, 5), np.int32), "int32"),
            (np.full((4, 5), np.nan), "not numbers"),
            (np.full((4, 5), 255.0), "divide it by 255"),
            ("photo.jpg", "str"),
        ],
    )
    def test_refused(self, value, words):
        """What cannot be a picture is refused with what was given."""
        with pytest.raises(ValueError, match=words):
            image_from_array(value)

    def test_copies(self):
        """The caller's array stays the caller's: freezing the image does not freeze it."""
        array = smooth()
        image = image_from_array(array)
        assert not np.shares_memory(image.pixels, array)


class TestEncode:
    def test_same_encoding_is_the_same_object(self):
        """Nothing is computed where nothing changes."""
        image = Image(smooth())
        assert encode(image, encoding="srgb") is image

    def test_there_and_back(self):
        """Linear and back is the same picture."""
        image = encode(encode(Image(smooth()), encoding="linear"), encoding="srgb")
        np.testing.assert_allclose(image.pixels, smooth(), atol=2e-6)


class TestResize:
    @pytest.mark.parametrize(("size", "expected"), [((40, 60), (20, 30)), ((60, 40), (30, 20)), ((1, 600), (1, 30))])
    def test_long_side(self, size, expected):
        """The longer side gets the length asked for, the other follows and is at least one pixel."""
        assert resize(Image(smooth(*size)), long_side=30).pixels.shape[:2] == expected

    def test_small_pictures_are_left(self):
        """A picture that already fits is the same object."""
        image = Image(smooth())
        assert resize(image, long_side=100) is image

    def test_enlarge(self):
        """Enlarging happens when asked for, and keeps the alpha in 0..1."""
        image = Image(smooth(), (smooth(channels=1)[..., 0] > 0.5).astype(np.float32))
        large = resize(image, long_side=120, enlarge=True)
        assert large.pixels.shape == (80, 120, 3)
        assert large.alpha is not None
        assert 0 <= large.alpha.min() <= large.alpha.max() <= 1

    def test_averages_light_not_code_values(self):
        """Half black, half white is half the light: sRGB 0.735, not 0.5."""
        stripes = np.zeros((2, 64, 3), np.float32)
        stripes[:, ::2] = 1
        np.testing.assert_allclose(resize(Image(stripes), long_side=32).pixels, 0.7354, atol=1e-3)
