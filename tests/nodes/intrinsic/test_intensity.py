"""The paper's intrinsic images: shading is intensity."""

from __future__ import annotations

import numpy as np
import pytest

from graphface.nodes.intrinsic.intensity import intensity
from graphface.nodes.types import (
    Image,
)

PHOTOS = {
    "black": lambda rng: np.zeros((6, 5, 3)),
    "white": lambda rng: np.ones((6, 5, 3)),
    "flat": lambda rng: np.full((6, 5, 3), (0.7, 0.4, 0.3)),
    "saturated": lambda rng: (rng.random((6, 5, 3)) > 0.5).astype(float),
    "noise": lambda rng: rng.random((6, 5, 3)),
    "dim": lambda rng: rng.random((6, 5, 3)) / 255,
    "brighter than white": lambda rng: rng.random((6, 5, 3)) * 3,
}


@pytest.fixture(params=PHOTOS)
def photo(request, rng):
    return Image(PHOTOS[request.param](rng).astype(np.float32))


class TestIntensity:
    @pytest.mark.parametrize("measure", ["mean", "luma", "value"])
    def test_product_is_the_photo(self, photo, measure):
        """Albedo times shading gives the photo back."""
        parts = intensity(photo, measure=measure)
        np.testing.assert_allclose(parts.albedo * parts.shading[..., None], photo.pixels, atol=1e-5)

    def test_shading_keeps_its_floor(self, photo):
        """The divisor is never below the floor, so the albedo is bounded."""
        parts = intensity(photo, floor=0.1)
        assert parts.shading.min() >= np.float32(0.1)
        assert np.isfinite(parts.albedo).all()

    def test_black_has_no_color(self):
        """Nearly black pixels get a nearly black albedo instead of amplified noise."""
        albedo = intensity(Image(np.float32([[[1 / 255, 0, 0]]]))).albedo
        assert albedo.max() < 0.05
