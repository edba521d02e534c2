"""Every intrinsic method on photos that break logarithms, divisions and solves."""

from __future__ import annotations

import numpy as np
import pytest

from graphface import GraphfaceWarning
from graphface.nodes.intrinsic.bell2014 import bell2014
from graphface.nodes.intrinsic.bilateral import bilateral
from graphface.nodes.intrinsic.intensity import intensity
from graphface.nodes.intrinsic.l1_flatten import l1_flatten
from graphface.nodes.intrinsic.log_tv import log_tv
from graphface.nodes.intrinsic.multiscale_retinex import multiscale_retinex
from graphface.nodes.intrinsic.retinex import retinex
from graphface.nodes.types import Image

METHODS = (intensity, retinex, multiscale_retinex, bilateral, log_tv, l1_flatten, bell2014)
QUICK = (intensity, retinex, multiscale_retinex, bilateral, log_tv, l1_flatten)
SHAPE = (37, 53, 3)

PHOTOS = {
    "black": lambda rng: np.zeros(SHAPE),
    "white": lambda rng: np.ones(SHAPE),
    "single colour": lambda rng: np.full(SHAPE, (0.8, 0.1, 0.05)),
    "salt and pepper": lambda rng: (rng.random(SHAPE) > 0.5).astype(float),
    "noise of one step": lambda rng: rng.integers(0, 2, SHAPE) / 255,
    "sixteen bits": lambda rng: rng.integers(0, 65536, SHAPE) / 65535,
    "half black": lambda rng: np.where(np.arange(53)[None, :, None] < 26, 0.0, 0.9) * np.ones(SHAPE),
    "beyond white": lambda rng: rng.random(SHAPE) * 50,
    "a little below black": lambda rng: rng.random(SHAPE) - 0.02,
    "one pixel": lambda rng: rng.random((1, 1, 3)),
    "one row": lambda rng: rng.random((1, 40, 3)),
    "one column": lambda rng: rng.random((40, 1, 3)),
    "two pixels": lambda rng: rng.random((1, 2, 3)),
}


@pytest.mark.parametrize("method", METHODS, ids=lambda m: m.__name__)
class TestHardPhotos:
    @pytest.mark.parametrize("kind", PHOTOS)
    def test_finite_and_a_product(self, method, kind, rng):
        """Both maps are finite, shading is positive, and their product is the photo."""
        photo = Image(PHOTOS[kind](rng).astype(np.float32))
        parts = method(photo)
        assert np.isfinite(parts.albedo).all()
        assert np.isfinite(parts.shading).all()
        assert parts.shading.min() > 0
        scale = max(1.0, float(np.abs(photo.pixels).max()))
        np.testing.assert_allclose(parts.albedo * parts.shading[..., None], photo.pixels, atol=1e-5 * scale)

    @pytest.mark.parametrize("hole", [np.nan, np.inf, -np.inf])
    def test_holes_are_filled_and_reported(self, method, hole, rng):
        """A block of non-finite pixels leaves finite maps and a warning."""
        pixels = rng.random(SHAPE).astype(np.float32)
        pixels[5:15, 10:20] = hole
        with pytest.warns(GraphfaceWarning, match="not finite"):
            parts = method(Image(pixels))
        assert np.isfinite(parts.albedo).all()
        assert np.isfinite(parts.shading).all()

    def test_no_halo_beside_black(self, method):
        """A black bar makes no albedo or shading beyond what the photo's own range allows."""
        pixels = np.full((60, 60, 3), 0.6, np.float32)
        pixels[:, 28:32] = 0
        parts = method(Image(pixels))
        assert parts.shading.max() < 3
        assert parts.albedo.max() < 12.1

    @pytest.mark.parametrize("coverage", [0.0, 1e-9])
    def test_an_empty_mask_is_no_mask(self, method, coverage, rng):
        """Where the mask holds nothing the whole picture sets the scale."""
        photo = Image(rng.random(SHAPE).astype(np.float32))
        empty = np.full(SHAPE[:2], coverage, np.float32)
        np.testing.assert_array_equal(method(photo, empty).shading, method(photo).shading)


@pytest.mark.parametrize("method", METHODS, ids=lambda m: m.__name__)
def test_sixteen_megapixels(method):
    """A large photo goes through, finite (its content repeats, so that making it costs nothing)."""
    tile = np.random.default_rng(0).random((64, 64, 3)).astype(np.float32)
    parts = method(Image(np.tile(tile, (64, 64, 1))))
    assert np.isfinite(parts.shading).all()
