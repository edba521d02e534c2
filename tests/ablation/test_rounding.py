"""Figures as people say them, and which is the best."""

import math

import pytest

from graphface.ablation.rounding import best, duration, rounded


class TestRounded:
    @pytest.mark.parametrize(
        ("values", "unit", "texts"),
        [
            ([28.93211, 9.0], "dB", ["28.9 dB", "9.0 dB"]),
            ([12.34, 5.0], "°", ["12.3°", "5.0°"]),
            ([0.8412, 0.92], "", ["0.84", "0.92"]),
            ([0.00712, 0.0123], "", ["0.0071", "0.0123"]),
            ([0.98412, 0.98433], "", ["0.9841", "0.9843"]),
            ([28.91, 28.94], "dB", ["28.91 dB", "28.94 dB"]),
            ([1.0, None, 2.0], "", ["1.0", "", "2.0"]),
            ([0.0, 0.0], "", ["0.0", "0.0"]),
            ([1234.0, 1300.0], "", ["1234", "1300"]),
            ([math.inf, 0.5], "", ["inf", "0.50"]),
            ([], "dB", []),
        ],
    )
    def test_columns(self, values: list[float | None], unit: str, texts: list[str]) -> None:
        """As many digits as tell figures apart, the same in a whole column."""
        assert rounded(values, unit) == texts

    def test_twins_do_not_add_digits(self) -> None:
        """Figures that are equal need not be told apart."""
        assert rounded([0.5, 0.5, 0.7]) == ["0.50", "0.50", "0.70"]


@pytest.mark.parametrize(
    ("seconds", "text"),
    [(0.000412, "0.41 ms"), (0.0342, "34 ms"), (0.344, "340 ms"), (0.9999, "1 s"),
     (1.24, "1.2 s"), (74.9, "75 s"), (312.3, "312 s"), (0, "0 ms")],
)  # fmt: skip
def test_duration(seconds: float, text: str) -> None:
    """Two digits are all that anybody reads."""
    assert duration(seconds) == text


class TestBest:
    def test_direction(self) -> None:
        """The highest or the lowest, as the metric says; none where it does not."""
        assert best([1.0, 3.0, None], "higher") == {1}
        assert best([1.0, 3.0, None], "lower") == {0}
        assert best([1.0, 3.0], None) == set()

    def test_ties(self) -> None:
        """Several can be the best; where all are alike none is."""
        assert best([2.0, 2.0, 1.0], "higher") == {0, 1}
        assert best([2.0, 2.0], "higher") == set()
        assert best([2.0, math.nan], "higher") == set()
