"""Shares of the new light by label, skin that scatters or not, and the relit picture."""

from __future__ import annotations

import numpy as np
import pytest

from graphface import UsageError
from graphface.nodes.render.composite import composite
from graphface.nodes.render.hair_shine import hair_shine
from graphface.nodes.render.relit import relit
from graphface.nodes.render.response import response
from graphface.nodes.render.skin import skin
from graphface.nodes.types import DetailMap, Image, Scene, Segmentation

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
        """Face all of the new light, background its mixture, dull hair all, shiny hair what the scene says."""
        scene = Scene(background=0.25, hair=0.5)
        shine = hair_shine(striped(), thirds(), NOWHERE, bright=99)
        mixed = composite(OLD, NEW, scene, thirds(), shine)
        np.testing.assert_allclose(mixed[:, :3], 0.8)
        np.testing.assert_allclose(mixed[:, 6:], 0.5)
        np.testing.assert_allclose(mixed[:, 3], 0.8)
        np.testing.assert_allclose(mixed[:, 4], 0.6, atol=1e-6)

    def test_an_unchanged_light_changes_nothing(self):
        """Whatever the labels."""
        scene = Scene(background=0.25, hair=0.5)
        np.testing.assert_array_equal(composite(OLD, OLD, scene, thirds(), thirds().hair), OLD)

    def test_colored_new_light(self):
        """Three channels where either has three."""
        new = np.repeat(NEW[..., None], 3, axis=2)
        assert composite(OLD, new, Scene(background=0.5), thirds()).shape == (*SHAPE, 3)

    def test_dark_hair_does_not_glow(self):
        """Light added to hair half as bright as the light says is half as much (the ratio); on skin it is all there."""
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


class TestResponse:
    def test_skin_answers_in_full(self):
        """However dark its own shading is."""
        assert (response(OLD / 2, OLD, thirds())[:, :3] == 1).all()

    def test_never_more_than_in_full(self):
        """A pixel brighter than the light says, or without light, is not lit more than skin, nor less than nothing."""
        for own, estimated in ((NEW, OLD), (NEW, 0 * OLD), (0 * OLD, 0 * OLD)):
            held = response(own, estimated, thirds())
            assert held.min() >= 0
            assert held.max() <= 1


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


class TestSkin:
    def test_chooses_by_the_scene(self):
        """Scattered only where the scene scatters."""
        assert skin(Scene(), shading=OLD) is OLD
        assert skin(Scene(scatter=0.1), scattered=NEW) is NEW

    def test_says_what_is_missing(self):
        """Called without what it needs."""
        with pytest.raises(UsageError, match="needs the shading"):
            skin(Scene())


class TestRelit:
    PARTS = (np.ones((*SHAPE, 3), np.float32), NEW, DetailMap(np.zeros((*SHAPE, 3), np.float32)))

    def test_the_photos_own_light_returns_the_photo(self):
        """The very same object: nothing was computed."""
        photo = striped()
        assert relit(photo, Scene(mode="add")) is photo

    @pytest.mark.parametrize("encoding", ["srgb", "linear"])
    def test_highlights_only_brighten(self, encoding):
        """Light is added, in range, and where there is none nothing changes."""
        photo = Image(striped().pixels, encoding=encoding)
        shine = np.zeros((*SHAPE, 3), np.float32)
        shine[2:4, :3] = 0.2
        without, with_ = (relit(photo, Scene(), *self.PARTS, h).pixels for h in (None, shine))
        assert (with_ >= without - 1e-6).all()
        assert (with_[2:4, :3] > without[2:4, :3]).all()
        np.testing.assert_array_equal(with_[4:], without[4:])
