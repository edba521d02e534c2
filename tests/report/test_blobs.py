"""Pictures of a report are stored once, however often they are shown."""

import numpy as np

from graphface.report.blobs import Blobs
from graphface.values.picture import Picture

PIXELS = np.random.default_rng(0).integers(0, 255, (20, 30, 3), np.uint8)


def test_equal_ones_are_one() -> None:
    """Equal pictures and equal channels share their blobs; other ones do not."""
    blobs = Blobs()
    data = PIXELS / 255
    whole = blobs.sheet("", "Image", Picture(PIXELS, data=data))
    again = blobs.sheet("pixels", "Image", Picture(PIXELS.copy(), data=data.copy()))
    red = blobs.sheet("red", "Mask", Picture(PIXELS[::-1].copy(), data=data[..., 0]))
    assert (again.image, again.planes) == (whole.image, whole.planes)
    assert red.planes == whole.planes[:1]
    assert red.image != whole.image
    assert len(blobs.contents) == 1 + 3 + 1


def test_full() -> None:
    """A sheet says of what size of array its data were taken: of their own, unless the picture says another."""
    data = PIXELS[..., 0]
    assert Blobs().sheet("", "Mask", Picture(PIXELS, data=data)).full == (20, 30)
    assert Blobs().sheet("", "Mask", Picture(PIXELS, data=data, full=(200, 300))).full == (200, 300)


def test_diagram() -> None:
    """A picture without data has none."""
    sheet = Blobs().sheet("", "float", Picture(PIXELS, "a note"))
    assert sheet.packed is None
    assert sheet.planes == ()
    assert sheet.note == "a note"
