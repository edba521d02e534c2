"""Highlight reconstruction: a clipped channel comes back by the color around it; what was not clipped stays."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from shapes import eyes_apart

from graphface.nodes.blend.recombine import recombine
from graphface.nodes.detail.split import split
from graphface.nodes.image.unclipped import unclipped
from graphface.nodes.intrinsic.intensity import intensity
from graphface.nodes.types import Image

SIDE, INTEROCULAR = 96, 40.0
SKIN = np.float32([1.0, 0.72, 0.55])


def shiny(peak=1.3):
    """Skin of one color with a soft highlight in the middle, before a camera clips it: H x W x 3."""
    y, x = np.mgrid[:SIDE, :SIDE] - SIDE / 2
    brightness = 0.6 + (peak - 0.6) * np.exp(-(x * x + y * y) / 400)
    return (brightness[..., None] * SKIN).astype(np.float32)


def clipped(pixels):
    return Image(np.minimum(pixels, 1))


class TestUnclipped:
    def test_a_lost_channel_comes_back(self):
        """Red that is clipped follows from green and blue and the color of the skin around."""
        true = shiny()
        found = unclipped(clipped(true), eyes_apart(INTEROCULAR)).pixels
        lost = true[..., 0] > 1.02
        assert lost.any()
        np.testing.assert_allclose(found[lost], true[lost], rtol=0.03)

    def test_what_is_not_clipped_stays(self):
        """To the last bit."""
        photo = clipped(shiny(peak=0.9))
        np.testing.assert_array_equal(unclipped(photo, eyes_apart(INTEROCULAR)).pixels, photo.pixels)

    def test_full_white_stays(self):
        """Without an unclipped channel there is nothing to reconstruct from."""
        photo = Image(np.ones((20, 20, 3), np.float32))
        np.testing.assert_array_equal(unclipped(photo, eyes_apart(INTEROCULAR)).pixels, photo.pixels)

    def test_a_wall_is_not_raised(self):
        """Only skin is skin that lost its color."""
        photo = clipped(shiny())
        left = np.zeros((SIDE, SIDE), np.float32)
        left[:, : SIDE // 2] = 1
        found = unclipped(photo, eyes_apart(INTEROCULAR), left).pixels
        np.testing.assert_array_equal(found[:, SIDE // 2 :], photo.pixels[:, SIDE // 2 :])
        assert (found[:, : SIDE // 2] > 1.02).any()

    def test_full_white_on_skin_has_its_color(self):
        """A highlight that is clipped in all channels is skin when light is taken away from it."""
        pixels = clipped(shiny(peak=2.5)).pixels
        white = pixels.min(axis=2) == 1
        assert white.any()
        found = unclipped(Image(pixels), eyes_apart(INTEROCULAR), np.ones((SIDE, SIDE), np.float32)).pixels[white]
        assert (found > 1 - 1e-6).all()
        assert (found[:, 0] > 1.2 * found[:, 2]).all()

    def test_grey_stays_grey(self):
        """A black-and-white photo has no color to give back."""
        grey = np.repeat(np.minimum(shiny()[..., :1], 1), 3, axis=2)
        found = unclipped(Image(grey), eyes_apart(INTEROCULAR)).pixels
        np.testing.assert_allclose(found, grey, atol=1e-3)

    @given(st.integers(1, 24), st.integers(1, 24), st.floats(0, 1e4), st.integers(0, 2**32 - 1))
    def test_any_picture(self, height, width, interocular, seed):
        """Never darker, never more than `largest_gain` times as bright, whatever the size."""
        pixels = np.random.default_rng(seed).choice(np.float32([0, 0.5, 0.95, 1]), (height, width, 3))
        found = unclipped(Image(pixels), eyes_apart(interocular), largest_gain=1.5).pixels
        assert np.isfinite(found).all()
        assert (found >= pixels).all()
        assert (found <= 1.5 * pixels + 1e-6).all()


class TestRelit:
    """The detail map of a photo whose highlights were reconstructed."""

    PHOTO = clipped(shiny())
    SOURCE = unclipped(PHOTO, eyes_apart(INTEROCULAR))
    PARTS = intensity(SOURCE)
    LIGHT = np.full((SIDE, SIDE), 0.6, np.float32)
    DETAIL = split(PHOTO, PARTS.albedo, LIGHT, unclipped=SOURCE)

    def relit(self, factor):
        return recombine(self.PHOTO, self.PARTS.albedo, self.LIGHT * np.float32(factor), self.DETAIL).pixels

    def test_unchanged_light_returns_the_photo(self):
        """Clipped and half-clipped pixels included."""
        np.testing.assert_allclose(self.relit(1), self.PHOTO.pixels, atol=1e-6)

    def test_under_less_light_the_highlight_is_skin(self):
        """Not yellow: red falls last, since it was brightest."""
        middle = self.relit(0.5)[SIDE // 2, SIDE // 2]
        assert middle[0] / middle[1] == pytest.approx(SKIN[0] / SKIN[1], rel=0.1)
        yellow = recombine(
            self.PHOTO, (own := intensity(self.PHOTO)).albedo, self.LIGHT / 2, split(self.PHOTO, own.albedo, self.LIGHT)
        ).pixels[SIDE // 2, SIDE // 2]
        assert yellow[0] / yellow[1] < 0.95 * SKIN[0] / SKIN[1]

    def test_more_light_is_never_darker(self):
        """From dark to bright, pixel by pixel."""
        steps = np.stack([self.relit(f) for f in np.linspace(0.1, 2, 20)])
        assert np.diff(steps, axis=0).min() > -1e-6

    def test_the_map_is_not_used_up(self):
        """Recombining works in scratch memory of its own: map and albedo serve the next edit."""
        parts = [self.DETAIL.offset, self.DETAIL.gain, self.DETAIL.pivot, self.DETAIL.ceiling, self.PARTS.albedo]
        before = [part.copy() for part in parts]
        self.relit(0.7)
        for part, was in zip(parts, before, strict=True):
            np.testing.assert_array_equal(part, was)
