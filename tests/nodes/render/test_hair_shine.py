"""Specular highlights of hair."""

from __future__ import annotations

import numpy as np
import pytest

from graphface.nodes.render.hair_shine import hair_shine
from graphface.nodes.types import (
    Image,
    Segmentation,
)

SHAPE = (6, 9)


NOWHERE = np.zeros(SHAPE, np.float32)


def thirds():
    """Face, hair, background from left to right."""
    face, hair, background = (np.zeros(SHAPE, np.float32) for _ in range(3))
    face[:, :3], hair[:, 3:6], background[:, 6:] = 1, 1, 1
    return Segmentation(face, hair, background)


def striped():
    """Grey, with one bright strand in the hair."""
    pixels = np.full((*SHAPE, 3), 0.3, np.float32)
    pixels[:, 4] = 0.9
    return Image(pixels)


class TestHairShine:
    @pytest.mark.parametrize("value", [0.0, 0.5, 1.0])
    def test_flat_hair_does_not_shine(self, value):
        """No highlight where all pixels are alike, black and white photos included."""
        flat = Image(np.full((*SHAPE, 3), value, np.float32))
        assert not hair_shine(flat, thirds(), NOWHERE).any()

    def test_a_forehead_taken_for_hair_does_not_shine(self):
        """Where the geometry is sure of the face, the labels are not followed."""
        assert hair_shine(striped(), thirds(), NOWHERE, bright=99).any()
        assert not hair_shine(striped(), thirds(), NOWHERE + 1, bright=99).any()

    def test_no_hair(self):
        """A bald head has none."""
        labels = Segmentation(np.ones(SHAPE, np.float32), *(np.zeros(SHAPE, np.float32),) * 2)
        assert not hair_shine(striped(), labels, NOWHERE).any()
