"""A layer of makeup over a face that keeps its own skin."""

import numpy as np
import pytest

from graphface.nodes.makeup.layer import layer
from graphface.nodes.types import BareSkin, Image, Paint

DARK, PALE = np.float32([0.35, 0.22, 0.16]), np.float32([0.8, 0.65, 0.58])


@pytest.fixture
def own(face, rng):
    """Dark skin with grain."""
    grain = 1 + 0.05 * rng.standard_normal((*face.everywhere.shape, 1), np.float32)
    return Image(DARK * grain * face.everywhere[..., None])


def worn(face, own, opacity, departure, **choices):
    bare = BareSkin(DARK * face.everywhere[..., None], 0.02, 0.0, 1.0)
    paint = Paint(opacity, np.float32(departure) * (opacity > 0)[..., None], PALE)
    return layer(own, bare, paint, face.everywhere, face.surface, face.features, face.landmarks, **choices).pixels


class TestLayer:
    def test_what_is_bare_stays(self, face, own):
        """Beyond the paint the photo stays to the last bit."""
        opacity = face.disc(0.2).astype(np.float32)
        result = worn(face, own, opacity, (-1, 0, 0.2))
        np.testing.assert_array_equal(result[opacity == 0], own.pixels[opacity == 0])
        assert np.abs(result - own.pixels)[opacity > 0].min() > 0

    def test_no_paint(self, face, own):
        """Nothing worn returns the photo."""
        np.testing.assert_array_equal(worn(face, own, face.nowhere, 0), own.pixels)

    def test_opaque_paint_has_its_own_color(self, face, own):
        """On dark skin it looks as on the pale skin that it came from."""
        opacity = face.disc(0.2).astype(np.float32)
        departure = np.float32([0, -0.5, -1])
        result = worn(face, own, opacity, departure, exposure=0)
        middle = np.median(result[face.disc(0.08)], axis=0)
        np.testing.assert_allclose(middle, PALE * np.exp(departure), atol=0.03)

    def test_sheer_paint_filters_the_skin(self, face, own):
        """It multiplies what is below."""
        opacity = np.where(face.disc(0.2), np.float32(1e-6), np.float32(0))
        result = worn(face, own, opacity, (0, -0.2, -0.2))
        cheek = face.disc(0.08)
        ratio = result[cheek].mean(axis=0) / own.pixels[cheek].mean(axis=0)
        np.testing.assert_allclose(ratio, np.exp([0, -0.2, -0.2]), atol=0.03)

    def test_what_is_worn_is_not_put_on_again(self, face, own):
        """A photo that departs from its bare skin as the layer does stays as it is under sheer paint."""
        departure = np.float32([0, -0.2, -0.2])
        opacity = np.where(face.disc(0.2), np.float32(1e-6), np.float32(0))
        painted = Image(np.where((opacity > 0)[..., None], own.pixels * np.exp(departure), own.pixels))
        result = worn(face, painted, opacity, departure)
        cheek = face.disc(0.08)
        assert np.abs(result - painted.pixels)[cheek].mean() < 0.01

    def test_greasepaint_goes_on(self, face, own):
        """What covers the wearer's whole face covers this one, also where the reference did not show it."""
        half = face.everywhere.copy()
        half[:, : half.shape[1] // 2] = 0
        bare = BareSkin(DARK * face.everywhere[..., None], 0.02, 0.0, 1.0)
        cheek = face.disc(0.1)
        changed = {}
        for greasepaint in (0.0, 1.0):
            paint = Paint(face.everywhere, np.zeros_like(own.pixels), PALE, greasepaint)
            parts = (face.surface, face.features, face.landmarks, face.everywhere)
            changed[greasepaint] = np.abs(layer(own, bare, paint, half, *parts).pixels - own.pixels)[cheek].mean()
        assert half[cheek].max() == 0
        assert changed[0.0] == 0
        assert changed[1.0] > 0.02

    def test_the_openings_stay(self, face, own):
        """Eyes and teeth are never painted."""
        result = worn(face, own, face.everywhere, (-1, -1, 0))
        inside = face.features.openings > 0.999
        np.testing.assert_allclose(result[inside], own.pixels[inside], atol=1e-3)
