"""How far two values are apart, part by part."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from toys import Pair

from graphface.report.difference.values import PartDifference, differences


def only(one: Any, other: Any) -> PartDifference:
    (part,) = differences(one, other)
    return part


class TestArrays:
    def test_measures(self) -> None:
        """Greatest, mean, share, position and box of what differs."""
        one = np.zeros((10, 20, 3), np.float32)
        other = one.copy()
        other[4, 7, 1], other[6, 9, 0] = -0.5, 0.25
        part = only(one, other)
        assert (part.greatest, part.position) == (0.5, (4, 7, 1))
        assert part.mean == pytest.approx(0.75 / 600)
        assert part.share == pytest.approx(2 / 200)
        assert part.box == (7, 4, 3, 3)

    def test_psnr(self) -> None:
        """Of values in [0, 1] the peak is 1: a tenth off everywhere is 20 dB."""
        one = np.full((6, 6), 0.5)
        assert only(one, one + 0.1).psnr == pytest.approx(20)

    def test_equal(self) -> None:
        """NaN equals NaN and an infinity itself."""
        one = np.array([np.nan, np.inf, -np.inf, 1.0])
        assert not list(differences(one, one.copy()))

    def test_what_is_not_finite_counts_without_a_size(self) -> None:
        """NaN on one side only, and infinities of different signs, are told apart from the size of the rest."""
        part = only(np.array([np.nan, np.inf, 1.0]), np.array([0.0, -np.inf, 1.5]))
        assert (part.non_finite, part.greatest, part.relative) == (2, 0.5, math.inf)
        assert part.position == (0,)

    def test_all_not_finite(self) -> None:
        """Nothing to measure is no error."""
        assert only(np.full((6, 6), np.nan), np.zeros((6, 6))).non_finite == 36

    def test_another_shape(self) -> None:
        """Says which; nothing is measured."""
        part = only(np.zeros((2, 3)), np.zeros((3, 2)))
        assert (part.words, part.relative) == ("shape [2, 3] became [3, 2]", math.inf)

    def test_another_dtype(self) -> None:
        """Equal numbers of another dtype are a difference of type, not of value."""
        assert only(np.zeros(3, np.float32), np.zeros(3)).words == "equal values, but float32 became float64"

    @pytest.mark.parametrize("dtype", [bool, np.uint8, np.int32, np.complex64])
    def test_other_numbers(self, dtype: type) -> None:
        """Differences of unsigned numbers do not wrap, and booleans have one."""
        assert only(np.array([0, 1], dtype), np.array([1, 1], dtype)).greatest == 1

    def test_texts_and_empty(self) -> None:
        """Arrays of text are equal or not; empty ones are equal."""
        assert "became" in only(np.array(["a"]), np.array(["b"])).words
        assert not list(differences(np.zeros((0, 3)), np.zeros((0, 3))))

    def test_span(self) -> None:
        """The range of the first side; of a constant its size, and 1 where there is none."""
        assert only(np.array([-2.0, 3.0]), np.array([-2.0, 3.5])).span == 5
        assert only(np.array([4.0]), np.array([5.0])).span == 4
        assert only(np.array([0.0]), np.array([1e-9])).relative <= 1e-9 / 1e-15


class TestParts:
    def test_records(self) -> None:
        """Only the parts that differ, by their path."""
        grid = np.zeros((2, 2))
        parts = list(differences(Pair(grid, grid), Pair(grid, grid + 1)))
        assert [(part.path, part.greatest) for part in parts] == [("high", 1)]

    def test_a_part_that_is_gone(self) -> None:
        """None in place of an array is a difference of type."""
        grid = np.zeros((2, 2))
        assert only(Pair(grid, grid), Pair(grid, None)).words == "float64[2, 2] 0..0 became None"

    def test_lists_and_mappings(self) -> None:
        """Lengths and keys are told, and what both have is compared."""
        assert [p.words or p.path for p in differences([1, 2], [1, 3, 4])] == ["2 items became 3", "[1]"]
        assert {p.path: p.words for p in differences({"a": 1}, {"b": 1})} == {"['a']": "gone", "['b']": "new"}

    def test_without_parts(self) -> None:
        """Texts, paths and sets are equal or not."""
        assert only("a", "b").words == "'a' became 'b'"
        assert not list(differences(Path("a"), Path("a")))
        assert "became" in only({1}, {2}).words
        assert not list(differences({1, 2}, {2, 1}))

    def test_numbers(self) -> None:
        """An int and a float are compared as numbers, a flag and a number are not."""
        assert only(1, 3.0).greatest == 2
        assert only(True, 1).words == "bool became int"

    def test_what_cannot_be_compared(self) -> None:
        """A comparison that raises is answered by how the values read."""

        class Odd:
            def __eq__(self, other: object) -> bool:
                raise TypeError

            __hash__ = None  # type: ignore[assignment]

            def __repr__(self) -> str:
                return "odd"

        assert not list(differences(Odd(), Odd()))

    def test_nested(self) -> None:
        """A path leads through records, lists and mappings."""

        @dataclass
        class Lamp:
            colors: dict[str, list[float]]

        assert only(Lamp({"key": [1.0]}), Lamp({"key": [2.0]})).path == "colors['key'][0]"
