"""Bars and curves."""

import numpy as np

from graphface.pictures.colors import NON_FINITE
from graphface.pictures.plots import draw_curve, draw_numbers
from graphface.values.picture import View


def painted(pixels: np.ndarray, color: tuple[int, int, int]) -> np.ndarray:
    return (pixels == color).all(axis=2)


class TestNumbers:
    def test_bars(self) -> None:
        """A longer bar for a larger number; negative ones to the other side; NaN in magenta."""
        pixels = draw_numbers([1.0, 2.0, -1.0, float("nan")], View(200)).pixels
        blue = painted(pixels, (52, 101, 164))
        starts = [np.flatnonzero(blue[4 + row * 16 + 6]) for row in range(3)]
        assert len(starts[1]) > 1.8 * len(starts[0])
        assert starts[2].max() <= starts[0].min() + 1
        assert painted(pixels, NON_FINITE).any()

    def test_many(self) -> None:
        """More than there is room for are a curve."""
        assert "over their index" in draw_numbers([float(n) for n in range(500)], View(100)).note


class TestCurve:
    def test_range_in_the_note(self) -> None:
        """How many, and from where to where; NaN left out and counted."""
        assert draw_curve(np.array([3.0, -1, 2]), View(100)).note == "3 values over their index, from -1 to 3"
        assert draw_curve(np.array([3.0, np.nan]), View(100)).note.endswith("magenta: not finite (1)")

    def test_peak_among_many(self) -> None:
        """One value among a hundred thousand is seen."""
        values = np.zeros(100_000)
        values[61_803] = 1
        blue = painted(draw_curve(values, View(200)).pixels, (52, 101, 164))
        assert blue[: blue.shape[0] // 2].any()
        assert abs(np.flatnonzero(blue[: blue.shape[0] // 2].any(axis=0)).mean() / 200 - 0.618) < 0.03

    def test_columns(self) -> None:
        """A table of up to four columns has a curve for each."""
        pixels = draw_curve(np.stack([np.zeros(50), np.ones(50)], axis=1), View(200)).pixels
        assert painted(pixels, (52, 101, 164)).any()
        assert painted(pixels, (204, 80, 40)).any()
