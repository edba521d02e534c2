"""Detail maps and recombination: photo = gain * rendering + offset, for every method."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from graphface.nodes import blend, detail
from graphface.nodes.intrinsic.intensity import intensity
from graphface.nodes.types import FileFormat, Image

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


class TestDetail:
    @pytest.mark.parametrize("method", [detail.additive, detail.multiplicative])
    @pytest.mark.parametrize("colored", [False, True])
    def test_same_shading_returns_the_photo(self, photo, method, colored, rng):
        """Recombined under the light it was made with, the photo comes back within 1/255."""
        shading = rng.uniform(0, 1.2, photo.pixels.shape if colored else photo.pixels.shape[:2]).astype(np.float32)
        albedo = intensity(photo).albedo
        again = blend.recombine(photo, albedo, shading, method(photo, albedo, shading))
        np.testing.assert_allclose(again.pixels, photo.pixels, atol=1 / 255 / 10)

    def test_none_is_the_bare_rendering(self, rng):
        """Without detail, what is left is albedo times shading."""
        photo = Image(rng.uniform(0.3, 0.7, (6, 5, 3)).astype(np.float32))
        albedo = intensity(photo).albedo
        shading = np.full((6, 5), 0.5, np.float32)
        bare = blend.recombine(photo, albedo, shading, detail.none(photo, albedo, shading), shoulder=0)
        np.testing.assert_allclose(bare.pixels, np.clip(albedo * 0.5, 0, 1), atol=1e-5)

    def test_multiplicative_is_the_shading_ratio(self, rng):
        """Doubling the shading doubles the picture where there is room."""
        photo = Image(rng.uniform(0.1, 0.2, (6, 5, 3)).astype(np.float32))
        albedo, shading = intensity(photo).albedo, np.full((6, 5), 0.3, np.float32)
        ratio = detail.multiplicative(photo, albedo, shading)
        np.testing.assert_allclose(
            blend.recombine(photo, albedo, 2 * shading, ratio).pixels, 2 * photo.pixels, rtol=1e-3
        )


class TestRecombine:
    def test_keeps_alpha_file_format_and_encoding(self):
        """What is not pixels is handed on."""
        alpha, form = np.full((2, 2), 0.5, np.float32), FileFormat("TIFF", 16, b"icc")
        photo = Image(np.full((2, 2, 3), 0.5, np.float32), alpha, "linear", form)
        albedo, shading = intensity(photo).albedo, np.ones((2, 2), np.float32)
        out = blend.recombine(photo, albedo, shading, detail.additive(photo, albedo, shading))
        assert out.alpha is alpha
        assert (out.encoding, out.file) == ("linear", form)

    @settings(max_examples=60, deadline=None)
    @given(
        st.floats(0, 1, width=32),
        st.floats(-1e6, 1e6, width=32),
        st.floats(-1e6, 1e6, width=32),
        st.sampled_from([0.0, 0.1, 0.5, 1.0]),
    )
    def test_stays_in_range_and_monotone(self, value, one, other, shoulder):
        """Any change leaves the pixel in [0, 1], and more light never gives a darker pixel."""
        low, high = sorted((one, other))
        photo = Image(np.full((1, 1, 3), value, np.float32))
        albedo = np.ones((1, 1, 3), np.float32)
        leftover = detail.additive(photo, albedo, np.float32([[value]]))
        results = [
            blend.recombine(photo, albedo, np.float32([[s]]), leftover, shoulder=shoulder).pixels.max()
            for s in (low, high)
        ]
        assert 0 <= results[0] <= results[1] + 1e-6 <= 1 + 2e-6
