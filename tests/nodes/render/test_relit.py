"""The relit picture: highlights, and the photo itself under its own light."""

from __future__ import annotations

import numpy as np
import pytest

from graphface import UsageError
from graphface.nodes.render.relit import relit
from graphface.nodes.types import (
    DetailMap,
    Image,
    Scene,
)

SHAPE = (6, 9)


OLD, NEW = np.full(SHAPE, 0.4, np.float32), np.full(SHAPE, 0.8, np.float32)


def striped():
    """Grey, with one bright strand in the hair."""
    pixels = np.full((*SHAPE, 3), 0.3, np.float32)
    pixels[:, 4] = 0.9
    return Image(pixels)


class TestRelit:
    PARTS = (np.ones((*SHAPE, 3), np.float32), NEW, DetailMap(np.zeros((*SHAPE, 3), np.float32)))

    def test_the_photos_own_light_returns_the_photo(self):
        """The very same object: nothing was computed."""
        photo = striped()
        assert relit(photo, Scene(mode="add")) is photo

    @pytest.mark.parametrize("encoding", ["srgb", "linear"])
    def test_highlights_only_brighten(self, encoding):
        """Light is added, in range, and where there is none nothing changes."""
        photo = Image(striped().pixels, encoding=encoding)
        shine = np.zeros((*SHAPE, 3), np.float32)
        shine[2:4, :3] = 0.2
        without, with_ = (relit(photo, Scene(), *self.PARTS, h).pixels for h in (None, shine))
        assert (with_ >= without - 1e-6).all()
        assert (with_[2:4, :3] > without[2:4, :3]).all()
        np.testing.assert_array_equal(with_[4:], without[4:])


class TestNeeds:
    def test_says_what_is_missing(self):
        """Called without the parts that a change of light needs."""
        with pytest.raises(UsageError, match="needs albedo, shading and detail"):
            relit(striped(), Scene(ambient=1))
