"""Where both photos show bare skin."""

from __future__ import annotations

import numpy as np
import pytest

from graphface.nodes.makeup.features import features
from graphface.nodes.transfer.skin import skin
from graphface.nodes.types import Image
from graphface.testing import check_node

SIDE = 200
EVERYWHERE = np.ones((SIDE, SIDE), np.float32)


@pytest.fixture
def landmarks(make_face):
    return make_face(size=SIDE, scale=0.45)[1]


def even():
    return Image(np.full((SIDE, SIDE, 3), 0.6, np.float32))


def at(landmarks, point):
    x, y = np.round(landmarks.points[point, :2]).astype(int)
    return y, x


class TestSkin:
    def test_features_are_none(self, landmarks):
        """Lips and brows are left out, unless they are asked for; cheeks are skin."""
        parts = features(even(), landmarks)
        found, with_lips = (skin(EVERYWHERE, even(), even(), parts, landmarks, lips=lips) for lips in (0.0, 1.0))
        lip, brow, cheek = at(landmarks, 17), at(landmarks, 105), at(landmarks, 50)
        assert found[lip] < 0.1
        assert with_lips[lip] > 0.5
        assert found[brow] < 0.1
        assert found[cheek] > 0.9

    @pytest.mark.parametrize("whose", ["photo", "reference"])
    def test_a_strand_is_none(self, whose, landmarks):
        """What is much darker than the skin around is left out, in whichever picture it is; a wrinkle is skin."""
        row, column = at(landmarks, 50)
        pictures = {"photo": even(), "reference": even()}
        pictures[whose].pixels[:, column - 2 : column + 3] = 0.08
        parts = features(even(), landmarks)
        assert skin(EVERYWHERE, **pictures, features=parts, landmarks=landmarks)[row, column] < 0.1
        pictures[whose].pixels[:, column - 2 : column + 3] = 0.45
        assert skin(EVERYWHERE, **pictures, features=parts, landmarks=landmarks)[row, column] > 0.9

    def test_no_core(self, landmarks):
        """The very mask comes back."""
        nothing = np.zeros_like(EVERYWHERE)
        assert skin(nothing, even(), even(), features(even(), landmarks), landmarks) is nothing

    def test_never_more_than_the_core(self, landmarks):
        """It is a part of the core, and it fades towards its edge."""
        core = np.zeros_like(EVERYWHERE)
        core[60:140, 60:140] = 1
        found = skin(core, even(), even(), features(even(), landmarks), landmarks)
        assert (found <= core).all()
        assert found[100, 61] < 0.5

    def test_node(self, landmarks):
        """It keeps an operator's promises."""
        check_node(skin, EVERYWHERE, even(), even(), features(even(), landmarks), landmarks)
