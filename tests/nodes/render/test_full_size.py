"""The relit picture at the photo's own size."""

from __future__ import annotations

import numpy as np
import pytest

from graphface import UsageError
from graphface.nodes.render.full_size import full_size
from graphface.nodes.types import Image, Scene

PHOTO = Image(np.full((8, 8, 3), 0.5, np.float32))
LIT = Scene(ambient=1)


class TestFullSize:
    def test_the_photos_own_light_returns_the_photo(self):
        """The very same object: nothing was computed."""
        assert full_size(PHOTO, Scene(mode="add")) is PHOTO

    def test_a_photo_of_the_working_size_is_relit_already(self):
        """The very same object again."""
        relit = PHOTO.with_pixels(PHOTO.pixels / 2)
        assert full_size(PHOTO, LIT, PHOTO, relit) is relit

    def test_says_what_is_missing(self):
        """Nothing, or only the pictures, of a smaller size."""
        small = Image(np.zeros((4, 4, 3), np.float32))
        with pytest.raises(UsageError, match="working, relit, landmarks"):
            full_size(PHOTO, LIT)
        with pytest.raises(UsageError, match="lacks landmarks, albedo"):
            full_size(PHOTO, LIT, small, small)
