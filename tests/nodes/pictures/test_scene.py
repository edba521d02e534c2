"""Scenes as diagrams."""

from __future__ import annotations

import numpy as np
import pytest

from graphface import read_yaml
from graphface.nodes.bench.shipped import shipped_scenes
from graphface.nodes.pictures.scene import draw_scene, lamp_color
from graphface.nodes.types import DirectionalLight, PointLight, Scene
from graphface.values.picture import View

RED = (1.0, 0.0, 0.0)


def lamp(scene: Scene) -> np.ndarray:
    """Row and column of the lamp's middle in the left plan, in shares of its side."""
    pixels = draw_scene(scene, View(600)).pixels[:300, :300].astype(int)
    found = np.argwhere((pixels[..., 0] > 200) & (pixels[..., 1] < 60))
    assert len(found)
    return found.mean(axis=0) / 300


def test_seen_from_above():
    """The picture's right is right, the viewer stands below; a lamp behind the head is drawn above it."""
    for azimuth, row, column in ((90, 0, 1), (-90, 0, -1), (0, 1, 0), (180, -1, 0)):
        at = lamp(Scene(lights=(PointLight(azimuth=azimuth, distance=4, color=RED),)))
        sign = np.where(np.abs(at - 0.51) > 0.08, np.sign(at - 0.51), 0)
        assert sign.tolist() == [row, column]


def test_distance():
    """A lamp farther away is drawn farther out, however far inside the rim."""
    out = [lamp(Scene(lights=(PointLight(azimuth=90, distance=d, color=RED),)))[1] for d in (1, 4, 1e4)]
    assert out[0] < out[1] < out[2] < 0.95


@pytest.mark.parametrize("path", shipped_scenes(), ids=lambda path: path.stem)
def test_shipped(path):
    """Every shipped scene, at any size."""
    scene = read_yaml(path, Scene)
    for size in (None, 96, 384):
        assert draw_scene(scene, View(size)).pixels.std() > 5


def test_ball():
    """The ball is bright on the side of the lamp; without light it is dark."""
    lit = draw_scene(Scene(lights=(DirectionalLight(azimuth=90),)), View(600)).pixels[300:452, :152].astype(int)
    assert lit[75, 130].mean() > lit[75, 20].mean() + 60
    assert draw_scene(Scene(), View(600)).pixels[375, 75].max() == 0


def test_lamp_color():
    """A dim lamp has its full color; one without light is dark."""
    assert lamp_color(DirectionalLight(intensity=0.01, color=RED))[0] == 255
    assert max(lamp_color(DirectionalLight(intensity=0))) < 40


def test_lamps_that_coincide():
    """Lamps that stand behind each other, seen from the side, are drawn beside each other: none hides another."""
    blue = (0.1, 0.2, 1.0)
    lights = (PointLight(azimuth=-60, distance=4, color=RED), PointLight(azimuth=60, distance=4, color=blue))
    side = draw_scene(Scene(lights=lights), View(600)).pixels[:300, 300:].astype(int)
    assert ((side[..., 0] > 200) & (side[..., 1] < 60)).sum() > 20
    assert ((side[..., 2] > 200) & (side[..., 0] < 130)).sum() > 20
