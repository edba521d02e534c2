"""Samples, surroundings, shadows."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from values import samples, surroundings

from graphface.nodes.pictures.relighting import draw_samples, draw_shadows, draw_surroundings
from graphface.nodes.types import DirectionalLight, Scene, Shadows
from graphface.values.picture import View


def test_samples():
    """A sample's values lie at its cell of the grid; elsewhere is NaN."""
    made = samples()
    picture = draw_samples(made, View())
    assert picture.full == (6, 8)
    assert picture.data[2, 3, 0] == made.before[19]
    np.testing.assert_array_equal(picture.data[0, 5, 1:4], made.normals[5])
    assert np.isnan(picture.data[2, 4:]).all()
    assert "20 samples" in picture.note


def test_colored_samples():
    """Three channels of shading have names of their own."""
    colored = replace(samples(), before=np.ones((20, 3), np.float32))
    assert draw_samples(colored, View()).channels[:3] == ("shading red", "shading green", "shading blue")


def test_surroundings():
    """A frame around the window; without a face none."""
    framed = draw_surroundings(surroundings(), View()).pixels
    assert (framed == (250, 170, 40)).all(axis=2)[4, 8:24].all()
    empty = draw_surroundings(replace(surroundings(), window=(0, 0, 0, 0)), View()).pixels
    assert not (empty == (250, 170, 40)).all(axis=2).any()


class TestShadows:
    def test_lights(self):
        """One map for each light, side by side."""
        shadows = Shadows((0, 2), np.float32([[[0, 1]], [[1, 0.5]]]))
        picture = draw_shadows(shadows, View())
        np.testing.assert_array_equal(picture.pixels[0, :, 0], [0, 255, 255, 128])
        np.testing.assert_array_equal(picture.data[0, :, 0], [0, 1, 1, 0.5])

    def test_names(self):
        """A large map names its light, and its kind where the scene is known."""
        shadows = Shadows((0,), np.ones((1, 200, 200), np.float32))
        scene = Scene(lights=(DirectionalLight(),))
        alone = draw_shadows(shadows, View()).pixels
        known = draw_shadows(shadows, View(above=lambda kind: scene if kind is Scene else None)).pixels
        assert (alone < 255).any()
        assert (known != alone).any()

    def test_none(self):
        """Without a light a sentence says so."""
        assert draw_shadows(Shadows((), np.ones((0, 2, 3), np.float32)), View()).pixels.size > 18
