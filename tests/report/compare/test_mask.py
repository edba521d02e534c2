"""Which pixels differ, at the size of a picture."""

import io

import numpy as np
from PIL import Image

from graphface.report.compare.mask import as_png, differing


def test_one_of_many() -> None:
    """One value of a large array is one place of a small mask."""
    one = np.zeros((1000, 700, 3), np.float32)
    other = one.copy()
    other[999, 0, 2] = 1e-20
    found = differing(one, other, (10, 7))
    assert found is not None
    assert (found.shape, np.argwhere(found).tolist()) == ((10, 7), [[9, 0]])


def test_nan_equals_nan() -> None:
    """As everywhere in a comparison."""
    one = np.full((4, 4), np.nan)
    found = differing(one, one.copy(), (4, 4))
    assert found is not None
    assert not found.any()


def test_never_larger_than_the_arrays() -> None:
    """A picture that was enlarged has the mask of its array."""
    found = differing(np.zeros((2, 3)), np.ones((2, 3)), (200, 300))
    assert found is not None
    assert found.shape == (2, 3)


def test_no_maps() -> None:
    """Arrays of other shapes, of one axis or without values have none."""
    assert differing(np.zeros((2, 3)), np.zeros((3, 2)), (2, 2)) is None
    assert differing(np.zeros(4), np.ones(4), (2, 2)) is None
    assert differing(np.zeros((0, 3)), np.zeros((0, 3)), (2, 2)) is None


def test_png() -> None:
    """Red where something differs, transparent elsewhere."""
    with Image.open(io.BytesIO(as_png(np.array([[True, False]])))) as image:
        left, right = (image.convert("RGBA").getpixel((x, 0)) for x in (0, 1))
    assert (left, right[3]) == ((255, 40, 30, 255), 0)
