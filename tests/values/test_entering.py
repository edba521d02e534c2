"""What enters a run is checked once, by its type, and brought to the dtype that its type has."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

import numpy as np
import pytest
from numpy.typing import NDArray

from graphface.values.entering import entered
from graphface.values.port_types import ANY, ArrayType, ListOf, PortType

SHARE = ArrayType("Share", "H W", low=0, high=1, dtype="float32", bounded=True)
LOOSE = ArrayType("Loose", "N", low=0, high=1)
Share = Annotated[NDArray[np.float32], SHARE]


@dataclass(frozen=True)
class Fan:
    corners: NDArray[np.float32]
    order: NDArray[np.int32]
    weight: Share | None = None

    def flaw(self) -> str | None:
        return "order leads outside" if self.order.max() >= len(self.corners) else None


def fan(**parts: object) -> Fan:
    return Fan(**({"corners": np.zeros((3, 2), np.float32), "order": np.arange(3, dtype=np.int32)} | parts))  # type: ignore[arg-type]


OF_FAN = PortType((Fan,))


class TestArrays:
    def test_as_it_is(self) -> None:
        """What fits is the same object."""
        array = np.ones((2, 2), np.float32)
        assert entered(array, PortType((SHARE,))) is array

    @pytest.mark.parametrize("dtype", [">f4", ">f8", "<f8", "f2", "bool", "u1", ">u2"])
    def test_converted(self, dtype: str) -> None:
        """Byte order and width are those of the type; a mask of bool or of bytes is obvious."""
        given = np.array([[0, 1]]) * (np.iinfo(dtype).max if np.dtype(dtype).kind == "u" else 1)
        found = entered(given.astype(dtype), PortType((SHARE,)))
        assert found.dtype == np.float32
        assert found.dtype.isnative
        np.testing.assert_array_equal(found, [[0, 1]])

    @pytest.mark.parametrize(
        ("value", "said"),
        [
            (np.full((2, 2), 1.5), "lies within 0 and 1, this one within 1.5 and 1.5"),
            (np.full((2, 2), np.nan), "not numbers"),
            (np.full((2, 2), 1e300), "not numbers"),
            (np.ones(2, np.float32), "expected shape"),
            (np.ones((2, 2), np.int32), "expected float32, got int32"),
        ],
    )
    def test_refused(self, value: np.ndarray, said: str) -> None:
        """What cannot be converted without a guess is not."""
        with pytest.raises(ValueError, match=said):
            entered(value, PortType((SHARE,)))

    def test_others_are_left(self) -> None:
        """A type that declares no dtype keeps that of its values, and its nominal range binds nobody."""
        given = np.array([2.0])
        assert entered(given, PortType((LOOSE,))) is given
        assert entered(given, ANY) is given
        assert entered(given.astype(">f8"), ANY).dtype == ">f8"

    def test_items(self) -> None:
        """Of a list, each."""
        (found,) = entered([np.ones((1, 1), bool)], PortType((ListOf(PortType((SHARE,))),)))
        assert found.dtype == np.float32


class TestRecords:
    def test_as_it_is(self) -> None:
        """What fits is the same object."""
        assert entered(one := fan(weight=np.ones((1, 1), np.float32)), OF_FAN) is one

    def test_converted(self) -> None:
        """By the annotations of its fields."""
        found = entered(fan(corners=np.ones((3, 2), ">f8"), order=np.arange(3), weight=np.ones((1, 1), bool)), OF_FAN)
        assert [a.dtype for a in (found.corners, found.order, found.weight)] == [np.float32, np.int32, np.float32]

    @pytest.mark.parametrize(
        ("parts", "said"),
        [
            ({"order": np.int32([0, 3])}, "order leads outside"),
            ({"order": np.int32([])}, "do not belong together"),
            ({"order": np.array([1 << 40])}, "order: expected int32, got int64"),
            ({"order": np.ones(3)}, "order: expected int32, got float64"),
            ({"corners": np.full((3, 2), np.inf, np.float32)}, "corners: has values that are not numbers"),
            ({"weight": np.full((1, 1), -2.0)}, "weight: a Share lies within"),
        ],
    )
    def test_refused(self, parts: dict[str, np.ndarray], said: str) -> None:
        """The part is named; what its own check stumbles over is no part that belongs there."""
        with pytest.raises(ValueError, match=said):
            entered(fan(**parts), OF_FAN)
        with pytest.raises(ValueError, match=rf"\[0\].*{said}"):
            entered((fan(**parts),), ANY)
