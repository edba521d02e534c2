"""What relighting computes once points into pictures, grids and windows, and only into them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from graphface.nodes.types import Samples, Surroundings


def flat(*shape):
    return np.zeros(shape, np.float32)


def whole(*numbers):
    return np.int32(numbers)


PLANE = flat(2, 3)
SAMPLES = Samples(
    (2, 3),
    (1, 2),
    whole(0, 1),
    whole(0, 5),
    flat(2, 3),
    flat(2, 3),
    flat(2),
    flat(2, 3),
    flat(2),
    whole(1),
    flat(1),
    PLANE,
    "srgb",
)
AROUND = Surroundings(PLANE, 2, (0, 1, 0, 2), flat(1, 2), np.zeros((1, 2), np.intp), flat(1, 2), 1.0)

BAD = [
    (replace(SAMPLES, cells=whole(0, 2)), "cells has indices"),
    (replace(SAMPLES, pixels=whole(0, 6)), "pixels has indices"),
    (replace(SAMPLES, rim=whole(2)), "rim has indices"),
    (replace(SAMPLES, coverage=flat(3, 2)), "coverage has the shape"),
    (replace(SAMPLES, weights=flat(3)), "weights has the shape"),
    (replace(AROUND, nearest=np.full((1, 2), 2)), "nearest has indices"),
    (replace(AROUND, nearest=np.zeros((0, 2), np.intp)), "nearest has the shape"),
    (replace(AROUND, cell=0), "cell is 0"),
    (replace(AROUND, window=(0, 2, 0, 2)), "is no part"),
    (replace(AROUND, total=flat(2, 2)), "total has the shape"),
    (replace(AROUND, nearest=np.zeros((2, 2), np.intp)), "nearest has the shape"),
]


@pytest.mark.parametrize("value", [SAMPLES, AROUND, replace(AROUND, nearest=whole(), total=flat(0), far=flat(0))])
def test_good(value):
    """Nothing is said of values that belong together, nor of surroundings without a face."""
    assert value.flaw() is None


@pytest.mark.parametrize(("value", "said"), BAD, ids=[said for _, said in BAD])
def test_bad(value, said):
    """The part is named, with what was expected."""
    with pytest.raises(AssertionError, match=said):
        raise AssertionError(value.flaw())
