"""Images from arrays."""

from __future__ import annotations

import io

import numpy as np
import PIL.Image as Pillow
import pytest
from pictures import smooth

from graphface import UnwritableFile
from graphface.nodes.io.image_read import read_image
from graphface.nodes.types import FileFormat, Image
from graphface.nodes.types.image import image_from_array


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


class TestImage:
    def test_with_pixels_keeps_the_rest(self):
        """Alpha, file and encoding, unless another encoding is named; pixels become float32."""
        image = Image(smooth(), smooth(channels=1)[..., 0], file=FileFormat(bits=16))
        other = image.with_pixels(smooth().astype(np.float64) / 2, "linear")
        assert other.pixels.dtype == np.float32
        assert other.alpha is image.alpha
        assert (other.file, other.encoding) == (image.file, "linear")
        assert image.with_pixels(smooth()).encoding == "srgb"

    def test_in_a_notebook(self):
        """It shows itself as a PNG, small enough for a page."""
        shown = Image(smooth(2000, 30))._repr_png_()
        with Pillow.open(io.BytesIO(shown)) as opened:
            assert (opened.format, opened.size) == ("PNG", (15, 1000))

    def test_save(self, tmp_path):
        """As `-o` would write it; another suffix is refused with a reason."""
        image = Image(smooth(), file=FileFormat(bits=8))
        image.save(tmp_path / "a.png")
        np.testing.assert_allclose(read_image(tmp_path / "a.png").pixels, image.pixels, atol=0.002)
        with pytest.raises(UnwritableFile):
            image.save(tmp_path / "a.txt")
