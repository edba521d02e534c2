"""The painted face continued over the whole picture."""

import numpy as np
import pytest

from graphface.nodes.makeup.boundary import boundary
from graphface.nodes.makeup.core import core
from graphface.nodes.types import Image


@pytest.fixture
def inner(face):
    return core(face.everywhere, face.everywhere, face.onto_itself, face.landmarks)


def grey(value):
    return Image(np.full((200, 200, 3), value, np.float32))


class TestBoundary:
    def test_no_change_stays_none(self, face, inner):
        """Where painting changed nothing, nothing changes beyond it either."""
        layer = boundary(face.photo, face.photo, inner, face.features, face.landmarks)
        np.testing.assert_allclose(layer.pixels, face.photo.pixels, atol=1e-4)

    def test_the_core_is_as_painted(self, face, inner, rng):
        """Where the core is 1 the layer is the painted picture."""
        painted = Image(rng.random((200, 200, 3), np.float32))
        layer = boundary(grey(0.5), painted, inner, face.features, face.landmarks)
        np.testing.assert_allclose(layer.pixels[inner == 1], painted.pixels[inner == 1], atol=1e-6)

    def test_a_tone_continues(self, face, inner):
        """A face made darker makes the neck darker by about as much, and there is no step between them."""
        layer = boundary(grey(0.6), grey(0.3), inner, face.features, face.landmarks).pixels
        np.testing.assert_allclose(layer, 0.3, atol=0.06)
        assert np.abs(np.diff(layer[..., 0], axis=0)).max() < 0.03

    def test_brighter_skin_is_not_coarser(self, face, inner, rng):
        """Beyond the painted face grain keeps its strength where the tone gets brighter: it is added, not scaled."""
        grain = 0.01 * rng.standard_normal((200, 200, 1)).astype(np.float32).repeat(3, axis=2)
        photo, painted = Image(0.25 + grain), Image(0.6 + grain)
        layer = boundary(photo, painted, inner, face.features, face.landmarks).pixels
        beyond = inner == 0
        assert layer[beyond].mean() > 0.5
        assert np.diff(layer, axis=0)[beyond[1:]].std() < 1.3 * np.diff(photo.pixels, axis=0)[beyond[1:]].std()

    def test_teeth_keep_their_color(self, face, inner):
        """Where a mouth is not painted the skin's new tone does not reach into it."""
        mouth, photo = face.features.mouth, grey(0.3)
        layer = boundary(photo, grey(0.6), inner * (mouth == 0), face.features, face.landmarks).pixels
        opening = mouth > 0.99 * mouth.max()
        assert np.abs(layer - photo.pixels)[opening].max() < 0.3 * (1.1 - mouth.max()) + 1e-6
        assert layer[face.features.lips > 0.95].mean() > 0.5

    def test_an_empty_core(self, face):
        """Where nothing is painted the very photo comes back."""
        assert boundary(face.photo, grey(0), face.nowhere, face.features, face.landmarks) is face.photo
