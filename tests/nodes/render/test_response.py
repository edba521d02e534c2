"""How much of added light a pixel reflects."""

from __future__ import annotations

import numpy as np
import pytest

from graphface.nodes.render.response import response
from graphface.nodes.types import Image, Landmarks, Segmentation

SHAPE = (6, 9)


OLD, NEW = np.full(SHAPE, 0.4, np.float32), np.full(SHAPE, 0.8, np.float32)


def thirds():
    """Face, hair, background from left to right."""
    face, hair, background = (np.zeros(SHAPE, np.float32) for _ in range(3))
    face[:, :3], hair[:, 3:6], background[:, 6:] = 1, 1, 1
    return Segmentation(face, hair, background)


class TestResponse:
    def test_skin_answers_in_full(self):
        """However dark its own shading is."""
        assert (response(OLD / 2, OLD, thirds())[:, :3] == 1).all()

    def test_never_more_than_in_full(self):
        """A pixel brighter than the estimated light, or without light, stays in 0..1."""
        for own, estimated in ((NEW, OLD), (NEW, 0 * OLD), (0 * OLD, 0 * OLD)):
            held = response(own, estimated, thirds())
            assert held.min() >= 0
            assert held.max() <= 1

    def test_noisy_shadow_takes_less_light(self):
        """In proportion to its brightness, and the user is told."""
        random, side = np.random.default_rng(0), 120
        light = np.where(np.arange(side) < side // 2, 0.06, 0.6)[None] * np.ones((side, 1))
        noisy = light * (1 + np.where(light < 0.5, 0.3, 0.02) * random.normal(size=light.shape))
        points = np.zeros((68, 3), np.float32)
        points[36, :2], points[45, :2] = (30, 50), (90, 50)
        own, skin = np.full(light.shape, 0.4, np.float32), np.ones(light.shape, np.float32)
        labels = Segmentation(skin, 0 * skin, 0 * skin)
        photo = Image(np.repeat(np.clip(noisy, 0, 1)[..., None], 3, 2).astype(np.float32))
        with pytest.warns(match="dark and noisy"):
            held = response(own, own, labels, photo, Landmarks(points, "ibug68"))
        assert (held[:, side // 2 :] == 1).all()
        assert 0.2 < held[:, : side // 2].mean() < 0.8
