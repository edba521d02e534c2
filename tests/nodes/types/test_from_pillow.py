"""What `PIL.Image.open` gives may be given for a photo, or for a mask."""

from __future__ import annotations

import numpy as np
import PIL.Image as Pillow
import pytest

from graphface import InputError, load
from graphface.nodes.types import Image
from graphface.nodes.types.from_pillow import is_pillow

GRAPH = """graphface: 1
inputs: {photo: Image}
nodes: {n: {use: image.encode, in: {photo: photo}, with: {encoding: srgb}}}
outputs: {n: n}
"""


def test_is_pillow(tmp_path):
    """Subclasses are too; arrays are not."""
    Pillow.new("L", (2, 2)).save(tmp_path / "a.png")
    assert is_pillow(Pillow.new("L", (2, 2)))
    assert is_pillow(Pillow.open(tmp_path / "a.png"))
    assert not is_pillow(np.zeros(2))


@pytest.mark.parametrize(
    ("mode", "color", "pixel", "alpha"),
    [
        ("1", 1, (1, 1, 1), None),
        ("L", 51, (0.2, 0.2, 0.2), None),
        ("I;16", 13107, (0.2, 0.2, 0.2), None),
        ("F", 0.5, (0.5, 0.5, 0.5), None),
        ("RGB", (255, 51, 0), (1, 0.2, 0), None),
        ("RGBA", (255, 51, 0, 51), (1, 0.2, 0), 0.2),
        ("LA", (51, 51), (0.2, 0.2, 0.2), 0.2),
        ("P", 0, (0, 0, 0), None),
        ("CMYK", (0, 255, 255, 0), (1, 0, 0), None),
    ],
)
def test_modes(mode, color, pixel, alpha):
    """Every mode becomes RGB in 0..1, with its alpha."""
    image = Image.coerce(Pillow.new(mode, (3, 2), color))
    assert image.pixels.shape == (2, 3, 3)
    np.testing.assert_allclose(image.pixels[0, 0], pixel, atol=0.01)
    assert (image.alpha is None) == (alpha is None)
    assert alpha is None or abs(image.alpha[0, 0] - alpha) < 0.01


def test_upright():
    """Its EXIF orientation is applied, as a file's is."""
    picture = Pillow.new("RGB", (3, 2))
    picture.getexif()[274] = 6
    assert Image.coerce(picture).pixels.shape == (3, 2, 3)


class TestGiven:
    def test_photo(self):
        """It runs, and is the same picture as the array."""
        array = np.arange(12, dtype=np.uint8).reshape(2, 2, 3)
        graph = load(GRAPH)
        found, expected = (graph.run(photo=given).outputs["n"] for given in (Pillow.fromarray(array), array))
        np.testing.assert_array_equal(found.pixels, expected.pixels)

    def test_other_byte_order(self):
        """So is an array of the other byte order."""
        array = np.arange(12, dtype=np.uint16).reshape(2, 2, 3) * 5000
        graph = load(GRAPH)
        for dtype in (">u2", ">f4", ">f8"):
            given = array.astype(dtype) / (65535 if "f" in dtype else 1)
            found = graph.run(photo=given.astype(dtype)).outputs["n"].pixels
            assert found.dtype.isnative
            np.testing.assert_allclose(found, array / 65535, atol=1e-5)

    def test_refused(self):
        """One of a mode that says nothing about white is a sentence."""
        with pytest.raises(InputError, match="'photo': expected a picture of uint8"):
            load(GRAPH).run(photo=Pillow.new("I", (2, 2)))

    @pytest.mark.parametrize("mask", [Pillow.new("L", (3, 2), 255), Pillow.new("1", (3, 2), 1), np.ones((2, 3), bool)])
    def test_mask(self, mask):
        """A mask may be one too, or an array of bool."""
        graph = load(
            "graphface: 1\ninputs: {photo: Image, mask: Mask}\n"
            "nodes: {n: {use: intrinsic.intensity, in: {photo: photo, mask: mask}}}\noutputs: {n: n}\n"
        )
        graph.run(photo=np.ones((2, 3, 3)), mask=mask)
