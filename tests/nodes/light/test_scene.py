"""A scene from the light of a photograph."""

from __future__ import annotations

import numpy as np
import pytest

from graphface.nodes.harmonics import ambient, basis
from graphface.nodes.light.scene import scene as scene_of
from graphface.nodes.types import (
    Image,
    Lighting,
)

PHOTO = Image(np.full((200, 160, 3), 0.5, np.float32))


class TestScene:
    def test_light_from_the_left_is_light_from_the_left(self):
        """The scene's light is brightest where the fitted one is."""
        light = Lighting(np.float32([2, 0, 0.6, -0.8]))
        scene = scene_of(light, PHOTO)
        left, right = np.float32([[-0.7, 0, 0.7]]), np.float32([[0.7, 0, 0.7]])
        values = scene.lights[0].values
        assert basis(left, 2) @ values > 1.5 * (basis(right, 2) @ values)

    def test_even_light_stays_even(self):
        """Ambient in, ambient out, of mean 1."""
        values = scene_of(ambient(0.3), PHOTO).lights[0].values
        normals = np.float32([[0, 0, 1], [1, 0, 0], [0, -0.6, 0.8]])
        np.testing.assert_allclose(basis(normals, 2) @ values, 1, atol=1e-3)

    def test_colored_light_stays_colored(self):
        """One light per channel."""
        light = Lighting(np.repeat(np.float32([[2], [0], [0], [0.5]]), 3, axis=1) * np.float32([1, 0.8, 0.5]))
        assert scene_of(light, PHOTO).colored

    def test_darkness(self):
        """A black reference gives even light, with a warning."""
        with pytest.warns(match="hardly any light"):
            assert scene_of(Lighting(np.zeros(4, np.float32)), PHOTO).ambient == 1
