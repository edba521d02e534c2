"""The paper's detail map."""

from __future__ import annotations

import numpy as np
import pytest

from graphface.nodes.blend.recombine import recombine
from graphface.nodes.detail.additive import additive
from graphface.nodes.intrinsic.intensity import intensity
from graphface.nodes.types import (
    Image,
)


class TestAdditive:
    @pytest.mark.parametrize("colored", [False, True])
    def test_same_shading_returns_the_photo(self, photo, colored, rng):
        """Recombined under the light it was made with, the photo comes back within 1/255."""
        shading = rng.uniform(0, 1.2, photo.pixels.shape if colored else photo.pixels.shape[:2]).astype(np.float32)
        albedo = intensity(photo).albedo
        again = recombine(photo, albedo, shading, additive(photo, albedo, shading))
        np.testing.assert_allclose(again.pixels, photo.pixels, atol=1 / 255 / 10)

    def test_is_the_difference(self):
        """Photo minus rendering, and no gain."""
        photo = Image(np.full((1, 1, 3), 0.5, np.float32))
        detail = additive(photo, np.ones((1, 1, 3), np.float32), np.full((1, 1), 0.3, np.float32))
        np.testing.assert_allclose(detail.offset, 0.2, atol=1e-7)
        assert detail.gain is None
