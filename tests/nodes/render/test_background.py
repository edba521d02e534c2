"""New and old shading mixed by the distance from the face."""

from __future__ import annotations

import numpy as np
import pytest
from shapes import eyes_apart

from graphface.nodes.render.background import background
from graphface.nodes.types import (
    Scene,
    Surface,
)

SIDE, INTEROCULAR = 160, 40.0


def face(side=SIDE, radius=45, soft=10.0):
    """A round face: its surface and its soft mask."""
    y, x = np.mgrid[:side, :side] - side // 2
    distance = np.hypot(x, y)
    coverage = (distance <= radius).astype(np.float32)
    flat = np.zeros((side, side, 3), np.float32)
    mask = np.clip((radius - distance) / soft, 0, 1).astype(np.float32)
    return Surface(flat, coverage * 0, coverage, np.zeros((side, side), np.int32), flat), mask


SURFACE, MASK = face()
LANDMARKS = eyes_apart(INTEROCULAR)


def gradient(side=SIDE):
    """A shading that falls from left to right over the face, 0 where there is no surface."""
    return (np.linspace(1, 0.2, side, dtype=np.float32) * np.ones((side, 1), np.float32)) * SURFACE.coverage


class TestBackground:
    def test_face_is_relit_fully(self):
        """On and beside the face the new shading stands."""
        old, new = np.zeros_like(MASK), np.ones_like(MASK)
        out = background(old, new, MASK, LANDMARKS, Scene(background=0.3))
        np.testing.assert_allclose(out[SURFACE.coverage > 0], 1, atol=1e-6)

    def test_far_away_is_the_scenes_share(self):
        """Beyond `far` it is the constant mixture, and in between it falls."""
        old, new = np.zeros_like(MASK), np.ones_like(MASK)
        out = background(old, new, MASK, LANDMARKS, Scene(background=0.3), near=0.1, far=0.6)
        assert out[80, 0] == pytest.approx(0.3, abs=0.01)
        assert (np.diff(out[80, 80:]) <= 1e-6).all()

    def test_share_one_hands_the_new_shading_on(self):
        """Nothing to mix, nothing computed."""
        new = np.ones_like(MASK)
        assert background(MASK, new, MASK, LANDMARKS, Scene(background=1)) is new

    def test_same_shading_stays_the_same(self):
        """Mixing equal shadings changes nothing, in one channel or three."""
        for shading in (gradient() + 0.2, np.repeat((gradient() + 0.2)[..., None], 3, axis=2)):
            out = background(gradient() + 0.2, shading.copy(), MASK, LANDMARKS, Scene(background=0.3))
            np.testing.assert_allclose(out, shading, atol=1e-6)
