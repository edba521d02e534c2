"""A face as it would look with even skin that wears nothing."""

import numpy as np
import pytest

from graphface import GraphfaceWarning
from graphface.nodes.makeup.bare_skin import bare_skin
from graphface.nodes.types import Image, Segmentation

SKIN = np.float32([0.75, 0.55, 0.45])
BLUE = np.float32([0.2, 0.3, 0.8])


def found(face, pixels):
    labels = Segmentation(face.everywhere, face.nowhere, face.nowhere)
    return bare_skin(Image(pixels), face.everywhere, labels, face.surface, face.features, face.landmarks)


@pytest.fixture
def skin(face):
    """Even skin in a light that falls off to one side."""
    light = np.linspace(0.6, 1.1, face.everywhere.shape[1], dtype=np.float32)
    return SKIN * light[None, :, None] * face.everywhere[..., None]


class TestBareSkin:
    def test_even_skin_is_bare(self, face, skin):
        """Even skin under a smooth light is the field itself."""
        bare = found(face, skin)
        inside = face.surface.coverage > 0.5
        assert np.abs(bare.color - skin)[inside].max() < 0.04
        assert bare.greasepaint == 0
        assert bare.colorful == 1

    def test_paint_does_not_move_it(self, face, skin):
        """A painted cheek changes the field by less than a tenth of what it changes the photo."""
        painted = skin.copy()
        cheek = face.disc(0.2)
        painted[cheek] = BLUE
        inside = face.surface.coverage > 0.5
        apart = np.abs(found(face, painted).color - found(face, skin).color)[inside].max()
        assert apart < 0.1 * np.abs(painted - skin).max()

    def test_greasepaint(self, face, skin):
        """A face that is blue all over wears greasepaint."""
        assert found(face, skin * 0 + BLUE).greasepaint == 1

    def test_black_and_white_is_no_greasepaint(self, face, skin):
        """A grey photo has no color of skin, and none of paint either."""
        bare = found(face, np.repeat(skin.mean(axis=2, keepdims=True), 3, axis=2))
        assert (bare.greasepaint, bare.colorful) == (0, 0)

    @pytest.mark.parametrize("shift", [(1, 0.97, 1.06), (0.97, 1, 1.1)])
    def test_a_tinted_photo_is_no_greasepaint(self, face, skin, shift):
        """A photo of next to no color, tinted, shows pale skin and not a white face."""
        tinted = np.repeat(skin.mean(axis=2, keepdims=True), 3, axis=2) * np.float32(shift)
        assert found(face, tinted).greasepaint == 0

    def test_dark_skin_in_warm_light_is_no_greasepaint(self, face, skin):
        """Its chroma in CIE Lab is 52; no makeup is so near the hue of skin."""
        light = skin.mean(axis=2, keepdims=True) / skin.mean()
        bare = found(face, np.float32([0.83, 0.45, 0.2]) * light * face.everywhere[..., None])
        assert bare.greasepaint == 0

    def test_no_skin(self, face, skin):
        """Without skin the field is a constant, with a warning."""
        labels = Segmentation(face.nowhere, face.everywhere, face.nowhere)
        with pytest.warns(GraphfaceWarning, match="too little skin"):
            bare = bare_skin(Image(skin), face.nowhere, labels, face.surface, face.features, face.landmarks)
        assert np.ptp(bare.color, axis=(0, 1)).max() == 0
        assert np.isfinite(bare.color).all()

    def test_black(self, face, skin):
        """A black photo gives a finite field above 0."""
        bare = found(face, skin * 0)
        assert np.isfinite(bare.color).all()
        assert bare.color.min() > 0
