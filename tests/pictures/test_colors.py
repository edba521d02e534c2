"""Numbers as grey and color."""

import numpy as np
import pytest

from graphface.pictures.colors import NON_FINITE, as_bytes, grey_of, mark_odd, share_beyond, with_odd


class TestAsBytes:
    def test_clips_and_rounds(self) -> None:
        """0..1 to 0..255; one channel becomes three."""
        np.testing.assert_array_equal(as_bytes(np.float32([[-1, 0.5, 2]]))[0, :, 0], [0, 128, 255])
        assert as_bytes(np.zeros((2, 2), np.float32)).shape == (2, 2, 3)

    def test_one_channel_that_is_not_finite(self) -> None:
        """It makes the pixel magenta."""
        pixels = as_bytes(np.float32([[[0, np.nan, 1], [0, 0, 0]]]))
        assert pixels[0].tolist() == [list(NON_FINITE), [0, 0, 0]]


class TestGreyOf:
    @pytest.mark.parametrize(
        ("values", "grey", "note"),
        [
            ([1, 2, 3], [0, 128, 255], "black is 1, white 3"),
            ([-3, 0, 1], [0, 128, 170], "mid grey is 0, black -3, white 3"),
            ([4, 4], [128, 128], "4 everywhere"),
        ],
    )
    def test_scale(self, values: list[float], grey: list[int], note: str) -> None:
        """By the values' own range, which the note states."""
        pixels, said = grey_of(np.array([values]))
        assert pixels[0, :, 0].tolist() == grey
        assert said == note


def test_share_beyond() -> None:
    """Pixels with any channel beyond the limit, to either side."""
    assert share_beyond(np.array([[0.0, 2, -2, 1]]), 1) == 0.5
    assert share_beyond(np.array([[[0.0, 2], [3, 3]], [[0, 0], [1, 1]]]), 1) == 0.5
    assert share_beyond(np.zeros((0, 3)), 1) == 0


def test_odd_values() -> None:
    """Counted by pixel; whole numbers are never odd."""
    odd = np.array([[np.nan, 1.0]])
    pixels = np.zeros((1, 2, 3), np.uint8)
    mark_odd(pixels, odd)
    assert pixels[0].tolist() == [list(NON_FINITE), [0, 0, 0]]
    assert with_odd("", odd) == "magenta: not finite (1 pixel)"
    assert with_odd("note", np.array([[1, 2]])) == "note"
