"""Arrays as numbers, curves, pictures, layers."""

import numpy as np
import pytest

from graphface.pictures.arrays import draw_array
from graphface.values.picture import View


@pytest.mark.parametrize(
    ("shape", "note"),
    [
        ((40,), "40 values over their index"),
        ((40, 3), "40 values over their index"),
        ((9, 8), "black is"),
        ((9, 8, 3), "red, green and blue are channels 0, 1 and 2; black is"),
        ((9, 8, 2), "mean of 2 channels; black is"),
        ((30, 20, 7), "mean of 7 channels; black is"),
        ((4, 9, 8), "4 layers, black is"),
        ((2, 2, 9, 8), "4 layers, black is"),
    ],
)
def test_by_shape(shape: tuple[int, ...], note: str) -> None:
    """What an array is drawn as follows from its shape, and is told in the note."""
    array = np.random.default_rng(1).random(shape)
    assert draw_array(array, View(100)).note.startswith(note)


def test_bytes_are_a_picture() -> None:
    """uint8 H x W x 3 is shown as it is."""
    array = np.arange(60, dtype=np.uint8).reshape(4, 5, 3)
    np.testing.assert_array_equal(draw_array(array, View()).pixels, array)
