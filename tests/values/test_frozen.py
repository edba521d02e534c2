"""Values are made immutable, measured and checked as they leave a node."""

from dataclasses import dataclass

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as npst

from graphface.values.frozen import arrays_in, describe, first_non_finite, freeze, is_finite


@dataclass(frozen=True)
class Box:
    inner: object
    name: str = "box"


class TestArraysIn:
    def test_paths(self) -> None:
        """Every array is found, with the path to it."""
        a, b, c = np.zeros(1), np.zeros(2), np.zeros(3)
        value = [Box(a), {"k": (b, Box(Box(c)))}, "text", None, 3]
        assert [(path, array.size) for path, array in arrays_in(value)] == [
            ("[0].inner", 1),
            ("[1].k[0]", 2),
            ("[1].k[1].inner.inner", 3),
        ]

    def test_plain(self) -> None:
        """An array itself has no path."""
        assert [path for path, _ in arrays_in(np.zeros(1))] == [""]


class TestFreeze:
    def test_nested(self) -> None:
        """All arrays of a value become read-only."""
        a, b = np.zeros(1), np.zeros(2)
        freeze([Box(a), {"k": b}])
        assert not a.flags.writeable
        assert not b.flags.writeable

    def test_behind_a_view(self) -> None:
        """So does the buffer behind a view: nobody can write through the back door."""
        whole = np.zeros(10)
        freeze(whole[2:4])
        assert not whole.flags.writeable

    def test_buffers_once(self) -> None:
        """Views of one buffer are one buffer."""
        whole = np.zeros(10)
        assert [b.size for b in freeze([whole[:2], whole[5:], whole])] == [10]


class TestFinite:
    def test_known_while_alive(self) -> None:
        """What was found finite is remembered no longer than the array lives."""
        known: dict[int, object] = {}
        array = np.zeros(3)
        assert first_non_finite(array, known) is None  # type: ignore[arg-type]
        assert len(known) == 1
        del array
        assert not known

    @given(
        npst.arrays(st.sampled_from([np.float16, np.float32, np.float64, np.complex64]), npst.array_shapes(max_side=4))
    )
    def test_agrees_with_numpy(self, array: np.ndarray) -> None:
        """The quick test says what NumPy says of every element."""
        with np.errstate(all="ignore"):
            assert is_finite(array) == bool(np.isfinite(array).all())

    @given(npst.arrays(np.float64, (3, 4), elements=st.floats(-1, 1)), st.integers(0, 2), st.integers(0, 3))
    def test_place(self, array: np.ndarray, row: int, column: int) -> None:
        """What is not finite is counted, and the first is placed."""
        array[row, column] = np.inf
        found = first_non_finite(Box(array), {})
        assert found is not None
        assert ".inner has 1 non-finite of 12" in found
        assert f"[{row}, {column}]" in found

    @pytest.mark.parametrize(
        "value", [1, True, "nan", None, b"", np.zeros(0), np.array([1, 2]), np.array(["x"]), [], {}]
    )
    def test_fine(self, value: object) -> None:
        """What cannot hold NaN is fine."""
        assert first_non_finite(value, {}) is None

    def test_remembered_by_object(self) -> None:
        """An array once found finite is not looked at again; another in its place is."""
        known: dict[int, object] = {}
        array = np.zeros(3)
        assert first_non_finite(array, known) is None
        array[0] = np.nan
        assert first_non_finite(array, known) is None
        assert first_non_finite(array.copy(), known) is not None


class TestDescribe:
    @pytest.mark.parametrize(
        ("value", "text"),
        [
            (np.zeros((2, 3), np.float32), "float32[2, 3] 0..0"),
            (np.array([1, np.nan, 5]), "float64[3] 1..5"),
            (np.zeros((0, 3)), "float64[0, 3]"),
            (np.array([True]), "bool[1] 1..1"),
            (Box(np.ones(1)), "Box(inner=float64[1] 1..1, name='box')"),
            ([1, 2], "list of 2: 1, ..."),
            (3.5, "3.5"),
        ],
    )
    def test_text(self, value: object, text: str) -> None:
        """A value is told in one short line."""
        assert describe(value) == text

    def test_all_nan(self) -> None:
        """An array of nothing but NaN is told without a warning."""
        assert describe(np.full(3, np.nan)) == "float64[3] nan..nan"

    def test_long(self) -> None:
        """A long value is cut."""
        assert len(describe("x" * 1000)) <= 60
