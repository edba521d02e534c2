"""Figures of an array are those of all its values."""

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from graphface.report.array_figures import BINS, figures


@pytest.mark.parametrize("kind", [np.float16, np.float32, np.float64, np.int32, np.uint8])
def test_like_numpy(kind: type) -> None:
    """Range, mean and histogram are NumPy's, over more values than one block has."""
    data = (np.random.default_rng(0).normal(50, 12, (400, 301))).astype(kind)
    found = figures(data)
    assert found is not None
    assert (found.low, found.high) == (data.min(), data.max())
    assert found.mean == pytest.approx(data.mean(dtype=np.float64), rel=1e-4)
    counts, _ = np.histogram(data.astype(np.float64), BINS)
    assert np.abs(counts - found.counts).sum() <= 4  # values on the edge of a bin
    assert (found.nan, found.infinite, sum(found.counts)) == (0, 0, data.size)


def test_no_numbers() -> None:
    """NaN and infinity are counted, and left out of everything else."""
    found = figures(np.array([[np.nan, 1, 2], [np.inf, 3, -np.inf]]))
    assert found is not None
    assert (found.low, found.high, found.mean, found.nan, found.infinite) == (1, 3, 2, 1, 2)
    assert sum(found.counts) == 3
    assert found.counted


def test_nothing_finite() -> None:
    """Without a finite value there is no range."""
    found = figures(np.full((2, 2), np.nan, np.float32))
    assert found is not None
    assert not found.counted
    assert found.counts == ()


def test_one_value() -> None:
    """One value has no histogram."""
    found = figures(np.full((4, 4), 7))
    assert found is not None
    assert (found.low, found.high, found.counts) == (7, 7, ())


@pytest.mark.parametrize("data", [np.zeros((0, 3)), np.array(["a"]), np.zeros(3, complex)])
def test_no_figures(data: NDArray[Any]) -> None:
    """Texts, complex numbers and nothing at all have no figures."""
    assert figures(data) is None
