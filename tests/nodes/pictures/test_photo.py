"""Photographs, and as backdrops."""

from __future__ import annotations

import numpy as np

from graphface.nodes.pictures.photo import backdrop, bytes_of, draw_image, photo_for, tinted
from graphface.nodes.types import Image
from graphface.values.picture import View


def photo_view(height: int, width: int, size: int | None = None) -> View:
    photo = Image(np.full((height, width, 3), 0.8, np.float32))
    return View(size, lambda kind: photo if kind is Image else None)


class TestImage:
    def test_is_encoded(self):
        """A linear image is shown as sRGB, clipped; its data stays linear."""
        image = Image(np.float32([[[0.21586, 2, -1]]]), encoding="linear")
        np.testing.assert_array_equal(bytes_of(image), [[[128, 255, 0]]])
        picture = draw_image(image, View())
        np.testing.assert_array_equal(picture.data, image.pixels)
        assert picture.note == "linear values; white is 1, 100.0% of the pixels are brighter"

    def test_transparent(self):
        """A checkerboard shows through."""
        image = Image(np.ones((32, 32, 3), np.float32), np.zeros((32, 32), np.float32))
        assert set(np.unique(draw_image(image, View()).pixels)) == {110, 150}


class TestBackdrop:
    def test_of_another_size(self):
        """The photo at another resolution is still the photo; one of another aspect is not."""
        assert photo_for(photo_view(40, 60), (20, 30), (20, 30)).shape == (20, 30, 3)
        assert photo_for(photo_view(40, 60), (30, 20), (30, 20)) is None

    def test_without_photo(self):
        """Plain grey."""
        assert set(np.unique(backdrop(View(), (4, 5), (4, 5)))) == {64}


def test_tinted():
    """Nothing where the weight is 0 or NaN; the color by its strength where it is 1; the photo is left alone."""
    under = np.full((1, 3, 3), 100, np.uint8)
    drawn = tinted(under, [np.float32([[0, 1, np.nan]])], [(200, 100, 0)], strength=0.5)
    assert drawn[0].tolist() == [[100, 100, 100], [150, 100, 50], [100, 100, 100]]
    assert (under == 100).all()
