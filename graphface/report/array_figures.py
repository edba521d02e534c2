"""What numbers say of a whole array: range, mean, share of NaN, histogram."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

BINS = 64
_BLOCK = 1 << 16


@dataclass(frozen=True)
class Figures:
    """Of all values of an array, not of those that a picture shows.

    Attributes:
        low, high, mean: of the finite values; 0 where there are none.
        nan, infinite: how many values are none.
        counts: of finite values in BINS equal parts of low..high.
    """

    dtype: str
    shape: tuple[int, ...]
    low: float
    high: float
    mean: float
    nan: int
    infinite: int
    counts: tuple[int, ...]

    @property
    def counted(self) -> bool:
        """Whether any value is finite."""
        return self.nan + self.infinite < math.prod(self.shape)


def figures(array: NDArray[Any]) -> Figures | None:
    """The figures of an array of numbers or booleans; None where it holds none.

    A report measures every array of a run, so the memory is gone through twice only, in blocks that stay in the CPU's
    cache: once for range and sum, once for the histogram. NaN is looked for where minimum or maximum are none.
    """
    if array.dtype.kind not in "biuf" or not array.size:
        return None
    numbers, nan, infinite = array.reshape(-1), 0, 0
    with np.errstate(all="ignore"):
        low, high, total = _range(numbers)
        if not (math.isfinite(low) and math.isfinite(high)):
            nan, infinite = int(np.isnan(numbers).sum()), int(np.isinf(numbers).sum())
            numbers = numbers[np.isfinite(numbers)]
            low, high, total = _range(numbers)
        counts = _histogram(numbers, low, high)
    return Figures(str(array.dtype), array.shape, low, high, total / max(numbers.size, 1), nan, infinite, counts)


def _range(numbers: NDArray[Any]) -> tuple[float, float, float]:
    """Minimum, maximum and sum; NaN where there is one, 0 of nothing."""
    if not numbers.size:
        return 0.0, 0.0, 0.0
    blocks = [numbers[start : start + _BLOCK] for start in range(0, numbers.size, _BLOCK)]
    found = np.array([(block.min(), block.max(), block.sum(dtype=_sum_type(block))) for block in blocks], np.float64)
    return float(found[:, 0].min()), float(found[:, 1].max()), float(found[:, 2].sum())


def _sum_type(block: NDArray[Any]) -> type[np.floating[Any]]:
    return np.float32 if block.dtype == np.float32 else np.float64


def _histogram(numbers: NDArray[Any], low: float, high: float) -> tuple[int, ...]:
    if high <= low or not math.isfinite(high - low):
        return ()
    from PIL import Image

    kind = np.float32 if numbers.dtype == np.float32 else np.float64
    unit, bins = np.empty(min(_BLOCK, numbers.size), kind), np.empty(min(_BLOCK, numbers.size), np.uint8)
    counts = np.zeros(BINS + 1, np.int64)
    for start in range(0, numbers.size, _BLOCK):
        block = numbers[start : start + _BLOCK]
        count = block.size
        np.subtract(block, kind(low), out=unit[:count])
        np.multiply(unit[:count], kind(BINS / (high - low)), out=unit[:count])
        np.copyto(bins[:count], unit[:count], casting="unsafe")
        counts += Image.frombuffer("L", (count, 1), bins[:count]).histogram()[: BINS + 1]  # np.bincount takes longer
    counts[BINS - 1] += counts[BINS]  # the largest number itself
    return tuple(int(n) for n in counts[:BINS])
