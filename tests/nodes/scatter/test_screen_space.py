"""A diffusion profile of skin."""

from __future__ import annotations

import numpy as np
from shapes import surface_with

from graphface.nodes.scatter.screen_space import PROFILE, screen_space
from graphface.nodes.types import (
    Image,
    Scene,
)


class TestProfile:
    def test_reflects_all_light(self):
        """The weights of each channel sum to 1, as published; variances increase."""
        np.testing.assert_allclose(np.sum([weights for _, weights in PROFILE], axis=0), 1, atol=0.011)
        assert (np.diff([variance for variance, _ in PROFILE]) > 0).all()


class TestScreenSpace:
    def test_red_travels_furthest(self, case):
        """The dark side of an edge turns warm."""
        beside = case.scattered(screen_space, case.step, 0.1)[30, 40 + 3]
        assert beside[0] > beside[1] >= beside[2] - 1e-6

    def test_depth_stops_light(self, case):
        """A step in depth as large as the radius keeps the edge sharp."""
        depth = np.ones_like(case.step)
        depth[:, 40:] = -40
        soft = case.scattered(screen_space, case.step, 0.1, case.with_depth(depth))
        np.testing.assert_allclose(soft[:, :70, 0], case.step[:, :70], atol=1e-3)

    def test_rows_and_columns_alike(self, case):
        """The blur of a transposed picture is the transposed blur."""
        turned = surface_with(
            np.ascontiguousarray(case.surface.normals.transpose(1, 0, 2)), case.surface.depth.T.copy()
        )
        photo = Image(np.zeros((*case.step.T.shape, 3), np.float32), encoding="linear")
        other = screen_space(case.step.T.copy(), case.old.T.copy(), turned, case.landmarks, photo, Scene(scatter=0.05))
        np.testing.assert_allclose(other.transpose(1, 0, 2), case.scattered(screen_space, case.step), atol=2e-3)
