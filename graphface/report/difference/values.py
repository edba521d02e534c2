"""How far two values are apart, part by part: by how much, how often and where.

What a value is made of is said by `graphface.values.parts`. NaN equals NaN and an infinity equals itself; a place where
only one of two arrays is finite, or where their infinities differ, counts as differing and has no size.
"""

from __future__ import annotations

import math
import numbers
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphface.values.frozen import describe
from graphface.values.parts import KEYED, NUMBERED, rule_of

_PIXEL_AXIS = 5
"""An array with two axes of at least so many rows and columns, or with three axes, is a map of pixels."""


@dataclass(frozen=True)
class PartDifference:
    """One part of a value that is not the same on both sides.

    Attributes:
        path: from the value to the part ("", "albedo", "lights[0].color").
        words: what differs where it is no matter of size: types, shapes, texts; empty otherwise.
        greatest, mean: of the absolute difference, over the places where both are finite.
        span: the range of the first side's values, against which a tolerance is taken; at least `greatest` / 1e6 and
            never 0.
        psnr: in dB, the peak being 1 where the first side lies in [0, 1], else its span; None where that says nothing.
        share: of the places (pixels, where there are any) that differ at all.
        non_finite: how many places are finite on one side only, or infinite in different ways.
        position: index of the greatest difference; of a map of pixels its row and column first.
        box: left, top, width and height of the pixels that differ; None for what is no map of pixels.
        shape: of the arrays.
    """

    path: str
    words: str = ""
    greatest: float = 0.0
    mean: float = 0.0
    span: float = 1.0
    psnr: float | None = None
    share: float = 1.0
    non_finite: int = 0
    position: tuple[int, ...] = ()
    box: tuple[int, int, int, int] | None = None
    shape: tuple[int, ...] = ()

    @property
    def relative(self) -> float:
        """The greatest difference over the span; infinite where the difference has no size."""
        return math.inf if self.words or self.non_finite else self.greatest / self.span


def differences(one: Any, other: Any, path: str = "") -> Iterator[PartDifference]:
    """The parts in which two values differ; none where they are equal.

    Args:
        one: the side whose range is the scale (the known-good one).
    """
    if one is other:
        return
    if isinstance(one, np.ndarray) and isinstance(other, np.ndarray):
        yield from _arrays(one, other, path)
    elif _is_number(one) and _is_number(other):
        yield from _arrays(np.asarray(one), np.asarray(other), path)
    elif type(one) is not type(other):
        yield PartDifference(path, f"{_kind(one)} became {_kind(other)}")
    else:
        yield from _alike(one, other, path)


def _alike(one: Any, other: Any, path: str) -> Iterator[PartDifference]:
    """Two values of one class."""
    rule = rule_of(type(one))
    if rule is None:
        if not _equal(one, other):
            yield PartDifference(path, f"{_short(one)} became {_short(other)}")
        return
    if isinstance(one, set | frozenset):
        if one != other:
            yield PartDifference(path, f"{_short(one)} became {_short(other)}")
        return
    parts = [dict(rule.items(value)) for value in (one, other)]
    if rule is NUMBERED and len(parts[0]) != len(parts[1]):
        yield PartDifference(path, f"{len(parts[0])} items became {len(parts[1])}")
    for label in {**parts[0], **parts[1]}:
        step = f"[{label!r}]" if rule is KEYED else rule.step(label)
        inner = f"{path}{step}".removeprefix(".")
        if label in parts[0] and label in parts[1]:
            yield from differences(parts[0][label], parts[1][label], inner)
        elif rule is not NUMBERED:
            yield PartDifference(inner, "gone" if label in parts[0] else "new")


def _arrays(one: NDArray[Any], other: NDArray[Any], path: str) -> Iterator[PartDifference]:
    if one.shape != other.shape:
        yield PartDifference(path, f"shape {list(one.shape)} became {list(other.shape)}")
    elif not all(array.dtype.kind in "fiubc" for array in (one, other)):
        if not np.array_equal(one, other):
            yield PartDifference(path, f"{describe(one)} became {describe(other)}")
    elif (differing := _where_differing(one, other)).any():
        yield _sized(one, other, differing, path)
    elif one.dtype != other.dtype:
        yield PartDifference(path, f"equal values, but {one.dtype} became {other.dtype}")


def _where_differing(one: NDArray[Any], other: NDArray[Any]) -> NDArray[np.bool_]:
    with np.errstate(invalid="ignore"):
        return np.asarray((one != other) & ~((one != one) & (other != other)))


def _sized(one: NDArray[Any], other: NDArray[Any], differing: NDArray[np.bool_], path: str) -> PartDifference:
    """The measures of two arrays of one shape that differ somewhere."""
    wide = np.complex128 if "c" in (one.dtype.kind, other.dtype.kind) else np.float64
    with np.errstate(invalid="ignore", over="ignore"):
        apart = np.abs(np.subtract(other, one, dtype=wide))
    sized = np.isfinite(apart)
    odd = int((differing & ~sized).sum())
    apart = np.where(sized, apart, 0.0)
    count = max(int(sized.sum()), 1)
    greatest, mean = float(apart.max()), float(apart.sum()) / count
    low, high = _range(one)
    span = max(high - low, abs(high) if high == low else 0.0, greatest * 1e-6) or 1.0
    peak = 1.0 if low >= 0 and high <= 1 and one.dtype.kind == "f" else span
    squared = float(np.square(apart).sum()) / count
    place = np.argmax(differing & ~sized) if odd else apart.argmax()
    pixels = _pixels(differing)
    return PartDifference(
        path,
        greatest=greatest,
        mean=mean,
        span=span,
        psnr=10 * math.log10(peak * peak / squared) if squared > 0 and one.size > 1 else None,
        share=float((differing if pixels is None else pixels).mean()),
        non_finite=odd,
        position=tuple(int(i) for i in np.unravel_index(int(place), one.shape)),
        box=None if pixels is None else _box(pixels),
        shape=one.shape,
    )


def _range(array: NDArray[Any]) -> tuple[float, float]:
    """Least and greatest finite value; of complex numbers, 0 and the greatest modulus."""
    values = np.abs(array) if array.dtype.kind == "c" else array
    finite = values[np.isfinite(values)]
    if not finite.size:
        return 0.0, 0.0
    low = 0.0 if array.dtype.kind == "c" else float(finite.min())
    return low, float(finite.max())


def _pixels(differing: NDArray[np.bool_]) -> NDArray[np.bool_] | None:
    """Which pixels differ, where the array is a map of pixels."""
    if differing.ndim == 3:
        return np.asarray(differing.any(axis=2))
    return differing if differing.ndim == 2 and min(differing.shape) >= _PIXEL_AXIS else None


def _box(pixels: NDArray[np.bool_]) -> tuple[int, int, int, int]:
    rows, columns = (np.flatnonzero(pixels.any(axis=axis)) for axis in (1, 0))
    return int(columns[0]), int(rows[0]), int(columns[-1] - columns[0]) + 1, int(rows[-1] - rows[0]) + 1


def _is_number(value: Any) -> bool:
    return isinstance(value, numbers.Number) and not isinstance(value, bool | np.bool_)


def _equal(one: Any, other: Any) -> bool:
    """Whether two values without parts are equal; those that cannot be compared are if they read the same."""
    try:
        return bool(one == other)
    except Exception:
        return repr(one) == repr(other)


def _kind(value: Any) -> str:
    return describe(value) if isinstance(value, np.ndarray) else "None" if value is None else type(value).__name__


def _short(value: Any) -> str:
    text = repr(value)
    return text if len(text) <= 80 else f"{text[:77]}..."
