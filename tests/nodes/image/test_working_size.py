"""The photo at the size at which a face is worked on."""

from __future__ import annotations

import numpy as np
import pytest

from graphface.nodes.image.working_size import working_size
from graphface.nodes.types import Image, Landmarks


def eyes(apart: float) -> Landmarks:
    """Landmarks whose outer eye corners are so many pixels apart."""
    points = np.zeros((468, 3), np.float32)
    points[263, 0] = apart
    return Landmarks(points, "facemesh468")


def photo(height: int = 300, width: int = 400) -> Image:
    return Image(np.full((height, width, 3), 0.25, np.float32), alpha=np.ones((height, width), np.float32))


class TestWorkingSize:
    def test_has_the_asked_pixels_between_the_eyes(self):
        """Areas are averaged; transparency stays with the photo."""
        small = working_size(photo(), eyes(100), resolution=25)
        assert small.pixels.shape == (75, 100, 3)
        np.testing.assert_allclose(small.pixels, 0.25, atol=1e-6)
        assert small.alpha is None

    @pytest.mark.parametrize("apart", [20, 100, 190])
    def test_what_would_hardly_get_smaller_stays(self, apart):
        """The very same object, up to four times the pixels."""
        own = photo()
        assert working_size(own, eyes(apart), resolution=100) is own

    def test_every_pixel_where_none_is_asked_for(self):
        """None is no bound, of the whole picture neither."""
        own = photo()
        assert working_size(own, eyes(300), resolution=None, megapixels=1e-3) is own

    def test_a_small_face_in_a_large_photo(self):
        """Megapixels bound what its resolution would ask for."""
        small = working_size(photo(), eyes(10), resolution=100, megapixels=0.0075)
        assert small.pixels.shape == (75, 100, 3)
