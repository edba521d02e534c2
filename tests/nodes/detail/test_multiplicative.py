"""The shading ratio."""

from __future__ import annotations

import numpy as np
import pytest

from graphface.nodes.blend.recombine import recombine
from graphface.nodes.detail.multiplicative import multiplicative
from graphface.nodes.intrinsic.intensity import intensity
from graphface.nodes.types import (
    Image,
)


class TestMultiplicative:
    @pytest.mark.parametrize("colored", [False, True])
    def test_same_shading_returns_the_photo(self, photo, colored, rng):
        """Recombined under the light it was made with, the photo comes back within 1/255."""
        shading = rng.uniform(0, 1.2, photo.pixels.shape if colored else photo.pixels.shape[:2]).astype(np.float32)
        albedo = intensity(photo).albedo
        again = recombine(photo, albedo, shading, multiplicative(photo, albedo, shading))
        np.testing.assert_allclose(again.pixels, photo.pixels, atol=1 / 255 / 10)

    def test_multiplicative_is_the_shading_ratio(self, rng):
        """Doubling the shading doubles the picture where it is far from white."""
        photo = Image(rng.uniform(0.1, 0.2, (6, 5, 3)).astype(np.float32))
        albedo, shading = intensity(photo).albedo, np.full((6, 5), 0.3, np.float32)
        ratio = multiplicative(photo, albedo, shading)
        np.testing.assert_allclose(recombine(photo, albedo, 2 * shading, ratio).pixels, 2 * photo.pixels, rtol=1e-3)
