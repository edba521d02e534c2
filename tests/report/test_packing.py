"""What is read under the cursor is what was there: exactly, or within half a step of its range."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays
from numpy.typing import NDArray

from graphface.report.packing import pack, unpack

SHAPES = arrays.array_shapes(min_dims=2, max_dims=3, max_side=7)
FLOATS = st.sampled_from((np.float16, np.float32, np.float64)).flatmap(
    lambda kind: arrays.arrays(kind, SHAPES, elements=st.floats(-60000, 60000, width=16))
)
ODD = arrays.arrays(np.float64, SHAPES, elements=st.floats(-1e300, 1e300) | st.sampled_from((np.nan, np.inf, -np.inf)))
WHOLE = st.sampled_from((np.uint8, np.int8, np.uint16, np.int16, np.bool_)).flatmap(
    lambda kind: arrays.arrays(kind, SHAPES)
)


def there_and_back(data: NDArray[Any]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """The values that were packed and those that are read, H x W x C; and half a step of each channel."""
    packed = pack(data)
    assert packed is not None
    return unpack(packed), np.asarray(packed.step) / 2


@given(FLOATS)
def test_floats(data: NDArray[Any]) -> None:
    """Floats are read within half a step of their channel's range."""
    read, half = there_and_back(data)
    wanted = data.reshape(read.shape).astype(np.float64)
    assert (np.abs(read - wanted) <= half * (1 + 1e-6) + 1e-12 * np.abs(wanted)).all()


@given(ODD)
def test_no_numbers(data: NDArray[np.float64]) -> None:
    """NaN and both infinities stay what and where they are, and do not widen the range of the others."""
    read, half = there_and_back(data)
    wanted = data.reshape(read.shape)
    finite = np.isfinite(wanted)
    np.testing.assert_array_equal(read[~finite], wanted[~finite])
    off = np.abs(np.where(finite, read, 0) - np.where(finite, wanted, 0))
    assert (off <= half * (1 + 1e-6) + 1e-12 * np.abs(np.where(finite, wanted, 0))).all()


@given(WHOLE)
def test_whole_numbers(data: NDArray[Any]) -> None:
    """Booleans and integers within 16 bits of range are exact."""
    packed = pack(data)
    assert packed is not None
    assert packed.exact
    assert packed.whole
    np.testing.assert_array_equal(unpack(packed), data.reshape(packed.height, packed.width, packed.channels))


@pytest.mark.parametrize(
    "data",
    [
        np.array([[np.iinfo(np.int64).min, np.iinfo(np.int64).min + 9]]),
        np.array([[2**64 - 1, 2**64 - 300]], np.uint64),
        np.array([[-(2**40), 2**40]]),
    ],
)
def test_large_whole_numbers(data: NDArray[Any]) -> None:
    """What 16 bits or a float64 cannot hold is read as nearly as they can, and does not claim to be exact."""
    packed = pack(data)
    assert packed is not None
    assert not packed.exact
    np.testing.assert_allclose(unpack(packed)[..., 0], data.astype(np.float64), rtol=1e-4)


def test_pictures_are_exact() -> None:
    """Steps of 1/255, as of an 8-bit photograph, take one byte and are exact."""
    data = (np.arange(256, dtype=np.uint8).reshape(16, 16, 1).repeat(3, 2) / np.float32(255)).astype(np.float32)
    packed = pack(data)
    assert packed is not None
    assert packed.bits == 8
    assert packed.exact
    np.testing.assert_array_equal(unpack(packed).astype(np.float32), data)


@pytest.mark.parametrize("value", [0.3, -2.5, 1e-300, np.nan, np.inf])
def test_one_value(value: float) -> None:
    """An array of one value is that value."""
    read, _ = there_and_back(np.full((3, 4), value))
    np.testing.assert_array_equal(read[..., 0], np.full((3, 4), value))


@pytest.mark.parametrize("data", [np.zeros((0, 4)), np.zeros(5), np.zeros((2, 2, 2, 2)), np.zeros((2, 2), complex)])
def test_no_picture(data: NDArray[Any]) -> None:
    """What is no array of pixels is not packed."""
    assert pack(data) is None


def test_smooth_is_small() -> None:
    """A smooth map takes a fraction of its 16 bits a pixel."""
    y, x = np.mgrid[:128, :128]
    packed = pack(np.sin(x / 40) * np.cos(y / 50))
    assert packed is not None
    assert len(packed.planes[0]) < 0.6 * 2 * 128 * 128
