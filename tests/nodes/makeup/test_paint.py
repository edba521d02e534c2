"""The layer of makeup that a face wears."""

import numpy as np
import pytest

from graphface.nodes.makeup.paint import paint
from graphface.nodes.types import BareSkin, Image

SKIN = np.float32([0.75, 0.55, 0.45])


@pytest.fixture
def bare(face):
    return BareSkin(SKIN * face.everywhere[..., None], 0.02, 0.0, 1.0)


def layer_of(face, bare, pixels, **choices):
    return paint(Image(pixels), bare, face.everywhere, face.surface, face.features, face.landmarks, **choices)


class TestPaint:
    def test_bare_skin_wears_nothing(self, face, bare):
        """Skin, and a shadow that keeps its color, are no paint."""
        pixels = bare.color.copy()
        pixels[face.disc(0.1)] *= 0.75
        layer = layer_of(face, bare, pixels)
        assert layer.opacity.max() < 0.02
        assert np.abs(layer.departure).max() < 0.02

    def test_a_strong_color_is_opaque(self, face, bare):
        """Blue on a cheek hides the skin, and the departure leads from skin to blue."""
        pixels, blue = bare.color.copy(), np.float32([0.2, 0.3, 0.8])
        cheek = face.disc(0.08)
        pixels[face.disc(0.2)] = blue
        layer = layer_of(face, bare, pixels)
        assert layer.opacity[cheek].min() > 0.95
        assert np.abs((SKIN + 0.02) * np.exp(layer.departure[cheek]) - 0.02 - blue).max() < 0.03

    def test_blush_is_sheer(self, face, bare):
        """A slightly redder cheek is a tint, not a mask."""
        pixels = bare.color.copy()
        pixels[face.disc(0.2)] *= np.float32([1, 0.85, 0.85])
        layer = layer_of(face, bare, pixels)
        cheek = face.disc(0.08)
        assert 0 < layer.opacity[cheek].mean() < 0.3
        assert layer.departure[cheek][:, 1].mean() < layer.departure[cheek][:, 0].mean() - 0.03

    def test_shadows_of_another_color(self, face, bare):
        """What departs from a face that is lit in several colors is no paint unless it departs by much more."""
        pixels = bare.color.copy()
        pixels[face.disc(0.2)] *= np.float32([0.8, 0.7, 0.6])
        cheek = face.disc(0.08)
        amounts = []
        for deviation in (0.02, 0.1, 0.2):
            uneven = BareSkin(bare.color, deviation, 0.0, 1.0)
            amounts.append(float(np.abs(layer_of(face, uneven, pixels).departure[cheek]).mean()))
        assert amounts[0] > 0.05
        assert amounts == sorted(amounts, reverse=True)
        assert amounts[-1] < 0.01
        pixels[face.disc(0.2)] = (0.2, 0.3, 0.8)
        assert layer_of(face, BareSkin(bare.color, 0.1, 0.0, 1.0), pixels).opacity[cheek].min() > 0.9

    def test_brows_are_no_paint(self, face, bare):
        """Hair of the brows is left out unless it is asked for."""
        pixels = bare.color.copy()
        brows = face.features.brows > 0.5
        pixels[brows] = (0.2, 0.15, 0.12)
        assert np.abs(layer_of(face, bare, pixels).departure[brows]).mean() < 0.1
        assert np.abs(layer_of(face, bare, pixels, brows=1).departure[brows]).mean() > 0.5

    def test_a_grey_photo_has_no_pigment(self, face, bare):
        """Of a black-and-white photo nothing is opaque."""
        pixels = bare.color.copy()
        pixels[face.features.lips > 0.3] = 0.1
        grey = BareSkin(bare.color, 0.02, 0.0, 0.0)
        assert layer_of(face, grey, pixels).opacity.max() == 0

    def test_nothing_is_seen(self, face, bare):
        """A hidden face wears nothing, a black one something finite."""
        hidden = paint(Image(bare.color), bare, face.nowhere, face.surface, face.features, face.landmarks)
        assert hidden.opacity.max() == 0
        black = layer_of(face, bare, bare.color * 0)
        assert np.isfinite(black.departure).all()
