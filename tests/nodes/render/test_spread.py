"""Shading beyond the face: continued without a seam, by the same operation for every light."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from shapes import eyes_apart

from graphface import GraphfaceWarning
from graphface.nodes.render.spread import spread as spread_over
from graphface.nodes.render.surroundings import surroundings
from graphface.nodes.types import (
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


def spread(shading, mask, surface, points):
    return spread_over(shading, surroundings(mask, surface, points))


def gradient(side=SIDE):
    """A shading that falls from left to right over the face, 0 where there is no surface."""
    return (np.linspace(1, 0.2, side, dtype=np.float32) * np.ones((side, 1), np.float32)) * SURFACE.coverage


class TestSpread:
    def test_keeps_the_face(self):
        """Where the mask is 1 the shading is untouched."""
        shading = gradient()
        np.testing.assert_allclose(spread(shading, MASK, SURFACE, LANDMARKS)[MASK == 1], shading[MASK == 1], atol=1e-6)

    def test_continues_each_side(self):
        """Left of the face it is as on its left side, right of it as on its right."""
        out = spread(gradient(), MASK, SURFACE, LANDMARKS)
        assert out[80, 0] > out[80, -1] + 0.2

    def test_stays_within_the_values_on_the_face(self):
        """Nothing beyond the face is brighter or darker than the face."""
        out, inside = spread(gradient(), MASK, SURFACE, LANDMARKS), gradient()[SURFACE.coverage > 0]
        assert inside.min() - 1e-4 <= out.min()
        assert out.max() <= inside.max() + 1e-4

    def test_leaves_no_seam(self):
        """Across the mask's edge it is nowhere steeper than a few times the shading's own slope."""
        out = spread(gradient(), MASK, SURFACE, LANDMARKS)
        assert np.abs(np.diff(out, axis=1)).max() < 3 * 0.8 / SIDE

    def test_is_linear(self, rng):
        """Spreading a sum is the sum of what is spread: an unchanged light stays unchanged everywhere."""
        one, two = (rng.random((SIDE, SIDE), dtype=np.float32) * SURFACE.coverage for _ in range(2))
        both = spread(one + 2 * two, MASK, SURFACE, LANDMARKS)
        apart = [spread(s, MASK, SURFACE, LANDMARKS) for s in (one, two)]
        np.testing.assert_allclose(both, apart[0] + 2 * apart[1], atol=1e-5)

    def test_colored_is_spread_channel_by_channel(self):
        """Three channels give what each gives alone."""
        colored = np.stack([gradient(), 0.5 * gradient(), 0 * gradient()], axis=2)
        out = spread(colored, MASK, SURFACE, LANDMARKS)
        np.testing.assert_allclose(out[..., 1], spread(colored[..., 1], MASK, SURFACE, LANDMARKS), atol=1e-6)

    def test_empty_mask_warns(self):
        """Without a face no light changes anything, with a warning."""
        with pytest.warns(GraphfaceWarning, match="mask is empty"):
            assert not spread(gradient(), MASK * 0, SURFACE, LANDMARKS).any()

    def test_full_mask_changes_nothing(self):
        """A face that fills the frame has nothing beyond it."""
        everywhere = Surface(SURFACE.normals, SURFACE.depth, MASK * 0 + 1, SURFACE.triangle, SURFACE.barycentric)
        shading = gradient() + 0.1
        np.testing.assert_allclose(spread(shading, MASK * 0 + 1, everywhere, LANDMARKS), shading, atol=1e-6)

    @settings(max_examples=30, deadline=None)
    @given(st.integers(1, 30), st.integers(1, 30), st.floats(0, 1e4), st.floats(1e-6, 1))
    def test_one_pixel_lights_all(self, height, width, interocular, weight):
        """A single face pixel of any weight, in a picture of any size, gives its shading to all of it."""
        coverage = np.zeros((height, width), np.float32)
        coverage[height // 2, width // 2] = 1
        flat = np.zeros((height, width, 3), np.float32)
        surface = Surface(flat, coverage * 0, coverage, np.zeros((height, width), np.int32), flat)
        mask = coverage * np.float32(weight)
        out = spread(coverage * np.float32(0.7), mask, surface, eyes_apart(interocular))
        np.testing.assert_allclose(out, 0.7, atol=1e-3)
