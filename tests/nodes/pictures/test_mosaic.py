"""Maps side by side."""

from __future__ import annotations

import numpy as np

from graphface.nodes.pictures.mosaic import mosaic, tile_view
from graphface.values.picture import Picture, View


def tile(value: float, channels: int = 0) -> Picture:
    shape = (2, 3, channels) if channels else (2, 3)
    names = tuple("abc"[:channels]) or ("value",)
    return Picture(np.full((2, 3, 3), int(value), np.uint8), "", np.full(shape, value, np.float32), names, (20, 30))


def test_values_lie_under_their_pixels():
    """Tile by tile, in the same places; what is left over is NaN."""
    joined = mosaic([(str(n), tile(10 * n)) for n in range(3)], "three")
    assert joined.pixels.shape == (4, 6, 3)
    np.testing.assert_array_equal(joined.data[..., 0][:, 0], [0, 0, 20, 20])
    np.testing.assert_array_equal(joined.data[0, 3:, 0], [10, 10, 10])
    assert np.isnan(joined.data[2:, 3:]).all()
    assert joined.full == (40, 60)


def test_channels():
    """A single channel beside three is repeated."""
    joined = mosaic([("a", tile(1, 3)), ("b", tile(2))], "", columns=2)
    assert joined.channels == ("a", "b", "c")
    assert joined.data.shape == (2, 6, 3)


def test_tile_view():
    """Tiles together have the size that was asked for; without one they are whole."""
    assert tile_view(View(400), 4).size == 200
    assert tile_view(View(), 4).size is None
