"""The shading of normals under a light."""

from __future__ import annotations

import numpy as np
from shapes import half_ball

from graphface.nodes.harmonics import ambient
from graphface.nodes.sh.render import render
from graphface.nodes.types import Lighting

NORMALS = half_ball()
EVERYWHERE = np.ones(NORMALS.shape[:2], np.float32)


class TestRender:
    def test_ambient_light_is_the_same_everywhere(self):
        """An ambient light gives every normal its irradiance, and pixels without a surface 0."""
        shading = render(ambient(0.7, order=2), NORMALS)
        covered = NORMALS.any(axis=2)
        np.testing.assert_allclose(shading[covered], 0.7, rtol=1e-5)
        assert not shading[~covered].any()

    def test_is_never_negative(self):
        """Where the polynomial dips below zero there is no light."""
        assert render(Lighting(np.float32([0, 0, 0, 1])), NORMALS).min() == 0

    def test_colored_light_has_three_channels(self):
        """Coefficients (n, 3) shade H x W x 3."""
        assert render(ambient(np.float32([1, 0.5, 0.2])), NORMALS).shape == (*EVERYWHERE.shape, 3)


def test_no_darker_than_the_floor():
    """A fitted light that is negative somewhere; where there is no surface there is no shading."""
    normals = np.zeros((1, 3, 3), np.float32)
    normals[0, 0, 2], normals[0, 1, 2] = 1, -1
    light = Lighting(np.float32([1, 0, 2, 0]))
    plain, floored = render(light, normals), render(light, normals, floor=0.05)
    assert plain[0, 1] == 0
    np.testing.assert_allclose(floored, [[plain[0, 0], 0.05, 0]])
