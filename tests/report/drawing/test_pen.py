"""Drawing with Pillow in a layout's coordinates."""

import numpy as np

from graphface.report.drawing.boxes import Rect
from graphface.report.drawing.pen import Pen


def test_box() -> None:
    """Twice as large at scale 2; a corner is round where both of its sides are named."""
    pen = Pen("#ffffff", 40, 20, 2)
    pen.box(Rect(10, 5, 20, 10), "#000000", None, round_at="rtb")
    pixels = np.asarray(pen.picture)[:, :, 0]
    assert pixels.shape == (40, 80)
    assert pixels[10, 20] == 0
    assert pixels[10, 60] == 255
    assert pixels[20, 40] == 0


def test_text_fits() -> None:
    """A text that is too long is cut to its room."""
    pen = Pen("#ffffff", 100, 20, 1)
    taken = pen.text(5, 15, "a very long name of a node", 50, 11, "#000000")
    assert taken <= 50
    assert np.asarray(pen.picture)[:, 58:].min() == 255


def test_dashes() -> None:
    """A dashed wire has gaps, a plain one has none."""
    for dashed in (False, True):
        pen = Pen("#ffffff", 60, 20, 1)
        pen.wire([(0, 60, 10)], "#000000", dashed=dashed)
        row = np.asarray(pen.picture)[10, 2:58, 0]
        assert bool(row.max() == 255) is dashed


def test_broken_thumbnail() -> None:
    """What is no picture is left out."""
    pen = Pen("#ffffff", 60, 20, 1)
    pen.paste("data:image/png;base64,nothing", Rect(0, 0, 60, 20))
    assert np.asarray(pen.picture).min() == 255
