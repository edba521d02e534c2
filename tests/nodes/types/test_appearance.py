"""Pictures of detail maps and textures."""

from __future__ import annotations

import numpy as np

from graphface.nodes.types import (
    DetailMap,
    Image,
    Texture,
)


class TestDetailMap:
    def test_picture(self):
        """Mid grey is no detail, for either kind of map."""
        nothing, one = np.zeros((1, 1, 3), np.float32), np.ones((1, 1, 3), np.float32)
        np.testing.assert_array_equal(DetailMap.picture(DetailMap(nothing)), 128)
        np.testing.assert_array_equal(DetailMap.picture(DetailMap(nothing, one)), 128)


class TestTexture:
    def test_picture(self):
        """Grey where nothing was seen."""
        texture = Texture(Image(np.ones((1, 2, 3), np.float32)), np.float32([[1, 0]]))
        np.testing.assert_array_equal(Texture.picture(texture)[0, :, 0], [255, 128])
