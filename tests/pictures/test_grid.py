"""Pictures beside each other under their labels."""

import numpy as np
import pytest

from graphface.pictures.grid import MOST, draw_grid
from graphface.values.picture import Picture, View


def red(view: View) -> Picture:
    assert view.size is not None
    return Picture(np.tile(np.uint8([200, 0, 0]), (view.size, view.size, 1)))


@pytest.mark.parametrize("count", [1, 2, 5, 12, 36, 200])
@pytest.mark.parametrize("size", [50, 200, 768])
def test_size(count: int, size: int) -> None:
    """All cells together are no larger than what was asked for."""
    picture = draw_grid([(f"cell {n}", red) for n in range(count)], View(size))
    assert max(picture.pixels.shape[:2]) <= 1.05 * size
    assert (picture.pixels == (200, 0, 0)).all(axis=2).any()


def test_left_out() -> None:
    """Of very many the first are drawn; the note counts all."""
    assert draw_grid([("", red)] * (MOST + 10), View(768)).note == f"{MOST + 10} parts"


def test_small_pictures_are_enlarged() -> None:
    """By whole pixels."""
    tiny = np.uint8([[[0, 0, 0], [255, 0, 0]]])
    pixels = draw_grid([("", lambda view: Picture(tiny))], View(100)).pixels
    assert (pixels == (255, 0, 0)).all(axis=2).sum() > 500
