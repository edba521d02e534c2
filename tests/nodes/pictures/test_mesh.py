"""Meshes from three sides."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from values import colors, mesh

from graphface.nodes.morphable.builtin import builtin_model
from graphface.nodes.pictures.mesh import draw_mesh, draw_model, draw_textured
from graphface.nodes.types import Image, Texture, TexturedMesh
from graphface.values.picture import View


def views(pixels):
    """The three views, and what of each is not paper."""
    parts = np.split(pixels, 3, axis=1)
    return [(part != (246, 246, 244)).any(axis=2) for part in parts]


def test_three_sides():
    """A face is widest from the front; its nose points to the right in the third view, where light is on the left."""
    picture = draw_model(builtin_model(), View(600))
    front, _, side = views(picture.pixels)
    widths = [np.ptp(np.flatnonzero(part.any(axis=0))) for part in (front, side)]
    assert widths[0] > 1.2 * widths[1]
    assert front.mean() > 0.2
    assert side[:, 150:].any()


def test_same_whatever_the_unit():
    """A mesh a thousand times as large, elsewhere, is drawn alike."""
    small = draw_mesh(mesh(), View(300)).pixels.astype(int)
    large = draw_mesh(replace(mesh(), vertices=mesh().vertices * 1000 + 5000), View(300)).pixels.astype(int)
    assert np.abs(small - large).mean() < 2


def test_textured():
    """In the texture's colors."""
    red = Texture(Image(np.tile(np.float32([1, 0, 0]), (8, 8, 1))), np.ones((8, 8), np.float32))
    pixels = draw_textured(TexturedMesh(mesh(), red), View(300)).pixels
    assert (pixels == (255, 0, 0)).all(axis=2).mean() > 0.1
    plain = TexturedMesh(replace(mesh(), uv=None), Texture(Image(colors(8, 8)), np.ones((8, 8), np.float32)))
    assert draw_textured(plain, View(300)).note.startswith("36 vertices")


def test_cannot_be_drawn():
    """Nothing, a point, and NaN are told in words."""
    for vertices in (np.zeros((36, 3), np.float32), np.full((36, 3), np.nan, np.float32)):
        assert draw_mesh(replace(mesh(), vertices=vertices), View(100)).pixels.shape == (75, 100, 3)
    nothing = replace(mesh(), vertices=np.zeros((0, 3), np.float32), triangles=np.zeros((0, 3), np.int32))
    assert draw_mesh(nothing, View(100)).pixels.size
