"""Detail maps and recombination: photo = gain * rendering + offset, for every method."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from graphface import GraphfaceWarning
from graphface.nodes.blend.recombine import recombine
from graphface.nodes.detail.additive import additive as additive_detail
from graphface.nodes.detail.edit.bands import EDGES, decomposed, gaussian, guided
from graphface.nodes.detail.edit.bands import bands as edit_bands
from graphface.nodes.detail.edit.shine import shine as edit_shine
from graphface.nodes.detail.edit.wrinkles import wrinkles as edit_wrinkles
from graphface.nodes.detail.multiplicative import multiplicative as multiplicative_detail
from graphface.nodes.detail.none import none as none_detail
from graphface.nodes.detail.split import split as split_detail
from graphface.nodes.intrinsic.intensity import intensity
from graphface.nodes.types import FileFormat, Image, Landmarks

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
    @pytest.mark.parametrize("method", [additive_detail, multiplicative_detail, split_detail])
    @pytest.mark.parametrize("colored", [False, True])
    def test_same_shading_returns_the_photo(self, photo, method, colored, rng):
        """Recombined under the light it was made with, the photo comes back within 1/255."""
        shading = rng.uniform(0, 1.2, photo.pixels.shape if colored else photo.pixels.shape[:2]).astype(np.float32)
        albedo = intensity(photo).albedo
        again = recombine(photo, albedo, shading, method(photo, albedo, shading))
        np.testing.assert_allclose(again.pixels, photo.pixels, atol=1 / 255 / 10)

    def test_none_is_the_bare_rendering(self, rng):
        """Without detail, what is left is albedo times shading."""
        photo = Image(rng.uniform(0.3, 0.7, (6, 5, 3)).astype(np.float32))
        albedo = intensity(photo).albedo
        shading = np.full((6, 5), 0.5, np.float32)
        bare = recombine(photo, albedo, shading, none_detail(photo, albedo, shading), shoulder=0)
        np.testing.assert_allclose(bare.pixels, np.clip(albedo * 0.5, 0, 1), atol=1e-5)

    def test_multiplicative_is_the_shading_ratio(self, rng):
        """Doubling the shading doubles the picture where there is room."""
        photo = Image(rng.uniform(0.1, 0.2, (6, 5, 3)).astype(np.float32))
        albedo, shading = intensity(photo).albedo, np.full((6, 5), 0.3, np.float32)
        ratio = multiplicative_detail(photo, albedo, shading)
        np.testing.assert_allclose(recombine(photo, albedo, 2 * shading, ratio).pixels, 2 * photo.pixels, rtol=1e-3)


class TestSplit:
    """Around the light of the photo: below it a bounded ratio, above it a difference."""

    @pytest.fixture
    def case(self, rng):
        photo = Image(rng.uniform(0.2, 0.5, (8, 9, 3)).astype(np.float32))
        return photo, intensity(photo).albedo, rng.uniform(0.2, 0.5, (8, 9)).astype(np.float32)

    def test_less_light_scales_the_pixel(self, case):
        """Taking light away scales what is there, highlights included, like the ratio."""
        photo, albedo, shading = case
        split = split_detail(photo, albedo, shading, bound=20, floor=1e-4)
        again = recombine(photo, albedo, shading / 2, split, shoulder=0)
        np.testing.assert_allclose(again.pixels, photo.pixels / 2, atol=0.01)

    def test_more_light_adds(self, case):
        """Adding light changes the pixel by the change of the rendering, like the paper's map."""
        photo, albedo, shading = case
        two = (method(photo, albedo, shading) for method in (split_detail, additive_detail))
        brighter = [recombine(photo, albedo, shading + 0.1, one).pixels for one in two]
        np.testing.assert_allclose(*brighter, atol=1e-5)

    def test_bound_of_one_is_additive(self, case):
        """With no room for a gain the method is the paper's."""
        np.testing.assert_allclose(split_detail(*case, bound=1).gain, 1, atol=1e-5)

    @settings(max_examples=60, deadline=None)
    @given(st.floats(0, 1, width=32), st.floats(0, 4, width=32), st.floats(1, 20, width=32))
    def test_gain_is_bounded(self, value, shade, bound):
        """Whatever the photo and the estimated shading, the gain is within its bound."""
        photo = Image(np.full((2, 2, 3), value, np.float32))
        albedo = np.ones((2, 2, 3), np.float32)
        gain = split_detail(photo, albedo, np.full((2, 2), shade, np.float32), bound=bound).gain
        assert gain.min() >= 1 / bound * (1 - 1e-4)
        assert gain.max() <= bound * (1 + 1e-4)

    def test_missing_landmarks_are_reported(self, case):
        """A cut-off without landmarks has no unit; the guess is said."""
        with pytest.warns(GraphfaceWarning, match="no landmarks"):
            split_detail(*case, cutoff=0.1)


class TestEdits:
    """Edits of a finished map."""

    @pytest.fixture
    def landmarks(self):
        points = np.zeros((468, 3), np.float32)
        points[263, 0] = 100
        return Landmarks(points, "facemesh468")

    @pytest.fixture(params=[additive_detail, split_detail])
    def made(self, request, rng):
        pixels = rng.random((40, 50, 3)).astype(np.float32) / 2
        pixels[10:20, 8:18] += 0.5  # a highlight
        photo = Image(pixels)
        return request.param(photo, intensity(photo).albedo, np.full((40, 50), 0.5, np.float32))

    @pytest.mark.parametrize("kernel", ["gaussian", "guided"])
    def test_bands_add_up(self, made, landmarks, kernel):
        """The bands and what is broader than all of them are the map."""
        broad = made.offset - sum(decomposed(made.offset, landmarks, kernel))
        smooth = guided if kernel == "guided" else gaussian
        np.testing.assert_allclose(broad, smooth(made.offset, EDGES[-1] * 100), atol=1e-5)

    def test_zero_removes_the_bands(self, made, landmarks):
        """With every band at 0 only the broad part is left."""
        bare = edit_bands(made, landmarks, pores=0, lines=0, folds=0)
        np.testing.assert_allclose(bare.offset, gaussian(made.offset, EDGES[-1] * 100), atol=1e-5)

    @pytest.mark.parametrize("edit", [edit_wrinkles, edit_shine])
    def test_strength_one_changes_nothing(self, made, landmarks, edit):
        """1 is the identity."""
        assert edit(made, landmarks, strength=1) is made

    def test_wrinkles_only_lift_dark_lines(self, made, landmarks):
        """Smoothing never darkens a pixel."""
        smoothed = edit_wrinkles(made, landmarks, strength=0)
        assert (smoothed.offset >= made.offset - 1e-6).all()

    def test_shine_only_dims_bright_patches(self, made, landmarks):
        """Making the skin matt never brightens a pixel."""
        matt = edit_shine(made, landmarks, strength=0)
        assert (matt.offset <= made.offset + 1e-6).all()

    @pytest.mark.parametrize("edit", [edit_wrinkles, edit_shine, edit_bands])
    def test_outside_the_mask_nothing_changes(self, made, landmarks, edit):
        """`where` limits the edit."""
        where = np.zeros((40, 50), np.float32)
        where[:, :25] = 1
        parameter = {"pores": 0.0} if edit is edit_bands else {"strength": 0.0}
        edited = edit(made, landmarks, where, **parameter)
        np.testing.assert_array_equal(edited.offset[:, 25:], made.offset[:, 25:])
        assert (edited.offset[:, :25] != made.offset[:, :25]).any() or made.gain is not None


class TestRecombine:
    def test_keeps_alpha_file_format_and_encoding(self):
        """What is not pixels is handed on."""
        alpha, form = np.full((2, 2), 0.5, np.float32), FileFormat("TIFF", 16, b"icc")
        photo = Image(np.full((2, 2, 3), 0.5, np.float32), alpha, "linear", form)
        albedo, shading = intensity(photo).albedo, np.ones((2, 2), np.float32)
        out = recombine(photo, albedo, shading, additive_detail(photo, albedo, shading))
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
        leftover = additive_detail(photo, albedo, np.float32([[value]]))
        results = [
            recombine(photo, albedo, np.float32([[s]]), leftover, shoulder=shoulder).pixels.max() for s in (low, high)
        ]
        assert 0 <= results[0] <= results[1] + 1e-6 <= 1 + 2e-6
