"""Shine, added or taken off."""

from __future__ import annotations

import numpy as np
import pytest

from graphface.nodes.transfer.shine import shine
from graphface.nodes.types import DetailMap, Image
from graphface.testing import check_node

SIDE = 200
EVERYWHERE = np.ones((SIDE, SIDE), np.float32)
SKIN_COLOR = np.float32([0.6, 0.45, 0.35])
Y, X = np.mgrid[:SIDE, :SIDE].astype(np.float32)


@pytest.fixture
def landmarks(make_face):
    return make_face(size=SIDE, scale=0.45)[1]


def shiny(light=0.0):
    """Skin with a white patch in the middle."""
    patch = light * np.exp(-(np.square(X - 100) + np.square(Y - 100)) / (2 * 6**2))
    return Image(np.asarray(SKIN_COLOR + patch[..., None], np.float32))


def shone(photo, reference, landmarks, **settings):
    own = DetailMap(np.zeros_like(photo.pixels))
    return shine(own, photo, EVERYWHERE, EVERYWHERE, landmarks, reference, **settings).offset


class TestShine:
    def test_off(self, landmarks):
        """Of strength 0 and 0 it returns the very map."""
        own = DetailMap(np.zeros((SIDE, SIDE, 3), np.float32))
        assert shine(own, shiny(), EVERYWHERE, EVERYWHERE, landmarks, shiny(0.3)) is own

    def test_more(self, landmarks):
        """Shine arrives as grey light; what the photo has already does not come twice."""
        change = shone(shiny(), shiny(0.3), landmarks, more=1.0)
        assert change[100, 100].min() > 0.1
        assert np.ptp(change[100, 100]) < 1e-5
        assert np.abs(change[20, 20]).max() < 1e-4
        assert shone(shiny(0.3), shiny(0.3), landmarks, more=1.0).max() < 0.03

    @pytest.mark.parametrize("reference", [shiny(), None])
    def test_less(self, reference, landmarks):
        """A matte reference, or none, leaves the color of the skin around."""
        photo = shiny(0.3)
        got = photo.pixels + shone(photo, reference, landmarks, less=1.0)
        around = np.abs(got[100, 100] / SKIN_COLOR - 1)
        assert around.max() < 0.25
        assert around.max() < 0.5 * np.abs(photo.pixels[100, 100] / SKIN_COLOR - 1).max()

    def test_node(self, landmarks):
        """It keeps an operator's promises."""
        own = DetailMap(np.zeros((SIDE, SIDE, 3), np.float32))
        check_node(shine, own, shiny(), EVERYWHERE, EVERYWHERE, landmarks, shiny(0.3), more=1.0)
