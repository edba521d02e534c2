"""Shares of the new light by label."""

from __future__ import annotations

import numpy as np

from graphface.nodes.render.composite import composite
from graphface.nodes.render.hair_shine import hair_shine
from graphface.nodes.render.response import response
from graphface.nodes.types import (
    Image,
    Scene,
    Segmentation,
)

SHAPE = (6, 9)


NOWHERE = np.zeros(SHAPE, np.float32)


OLD, NEW = np.full(SHAPE, 0.4, np.float32), np.full(SHAPE, 0.8, np.float32)


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


class TestComposite:
    def test_each_label_takes_its_share(self):
        """The face and dull hair get the new light, the background its mixture, shiny hair the scene's share."""
        scene = Scene(background=0.25, hair=0.5)
        shine = hair_shine(striped(), thirds(), NOWHERE, bright=99)
        mixed = composite(OLD, NEW, scene, thirds(), shine)
        np.testing.assert_allclose(mixed[:, :3], 0.8)
        np.testing.assert_allclose(mixed[:, 6:], 0.5)
        np.testing.assert_allclose(mixed[:, 3], 0.8)
        np.testing.assert_allclose(mixed[:, 4], 0.6, atol=1e-6)

    def test_a_lamp_keeps_its_light(self):
        """With labels and without them."""
        lamp = np.zeros(SHAPE, np.float32)
        lamp[2, 7] = 1
        for labels in (thirds(), None):
            mixed = composite(OLD, NEW, Scene(background=0.25, hair=0), labels, lamps=lamp)
            np.testing.assert_allclose(mixed[2, 7], 0.4)
            np.testing.assert_allclose(mixed[2, 8], 0.5 if labels else 0.8)

    def test_a_wall_of_its_own(self):
        """The background takes the wall's shading, by its share; face and hair do not."""
        mixed = composite(OLD, NEW, Scene(background=0.5, hair=0), thirds(), wall=np.full(SHAPE, 0.2, np.float32))
        np.testing.assert_allclose(mixed[:, :6], 0.8, atol=1e-6)
        np.testing.assert_allclose(mixed[:, 6:], 0.3, atol=1e-6)

    def test_response_counts_without_labels(self):
        """A scene that lights all like the face still adds less to what reflects less, and takes away in full."""
        half = np.full(SHAPE, 0.5, np.float32)
        scene = Scene(background=1, hair=0)
        np.testing.assert_allclose(composite(OLD, NEW, scene, response=half), 0.6, atol=1e-6)
        np.testing.assert_allclose(composite(NEW, OLD, scene, response=half), 0.4, atol=1e-6)

    def test_an_unchanged_light_changes_nothing(self):
        """Whatever the labels."""
        scene = Scene(background=0.25, hair=0.5)
        np.testing.assert_array_equal(composite(OLD, OLD, scene, thirds(), thirds().hair), OLD)

    def test_colored_new_light(self):
        """Three channels where either has three."""
        new = np.repeat(NEW[..., None], 3, axis=2)
        assert composite(OLD, new, Scene(background=0.5), thirds()).shape == (*SHAPE, 3)

    def test_dark_hair_does_not_glow(self):
        """Hair half as bright as the estimated light reflects half of added light (the ratio); skin reflects all."""
        held = response(OLD / 2, OLD, thirds())
        mixed = composite(OLD, NEW, Scene(background=1, hair=0), thirds(), None, held)
        np.testing.assert_allclose(mixed[:, :3], 0.8)
        np.testing.assert_allclose(mixed[:, 3:6], 0.6)

    def test_dark_hair_loses_light_like_all_else(self):
        """Only added light is held back."""
        mixed = composite(NEW, OLD, Scene(background=1, hair=0), thirds(), None, response(OLD / 2, NEW, thirds()))
        np.testing.assert_allclose(mixed, 0.4)

    def test_without_labels_all_is_face(self):
        """Nothing to blend."""
        assert composite(OLD, NEW, Scene(background=1, hair=0)) is NEW
