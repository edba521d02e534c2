"""Spheres and panoramas."""

from __future__ import annotations

import numpy as np
import pytest

from graphface.nodes.color import encode_srgb
from graphface.nodes.harmonics import ambient
from graphface.nodes.pictures.light import draw_direction, draw_environment, draw_fit, draw_lighting, main_direction
from graphface.nodes.types import Environment, Lighting, LightingFit
from graphface.values.picture import View


class TestLighting:
    def test_side(self):
        """Light from the picture's right makes the right half brighter, and the note names the side."""
        picture = draw_lighting(Lighting(np.float32([1.5, 0, 0.3, 0.8])), View(100))
        assert np.nanmean(picture.data[:, 60:]) > np.nanmean(picture.data[:, :40]) + 0.2
        assert "azimuth 69, elevation 0" in picture.note

    def test_even(self):
        """The same everywhere: shading 0.5 is grey 128, NaN beside the sphere."""
        picture = draw_lighting(ambient(0.5, 1), View(64))
        assert picture.pixels[32, 32].tolist() == [128, 128, 128]
        assert np.isnan(picture.data[0, 0])
        assert "from no side more" in picture.note

    def test_brighter_than_white(self):
        """Then white is the brightest point, as the note says."""
        assert "white is 3" in draw_lighting(ambient(3.0), View(64)).note

    def test_main_direction(self):
        """By the first order, the mean of the channels; order 0 has none."""
        np.testing.assert_allclose(main_direction(Lighting(np.float32([1, 0, 0, 2]))), [1, 0, 0])
        np.testing.assert_allclose(main_direction(Lighting(np.ones((4, 3), np.float32))), [3**-0.5] * 3, rtol=1e-6)
        assert not main_direction(Lighting(np.ones(1, np.float32))).any()


def test_fit():
    """The residual, exactly; the sphere lies in the corner."""
    residual = np.zeros((90, 90), np.float32)
    picture = draw_fit(LightingFit(ambient(0.5, 1), residual - 0.1, 12.0), View())
    np.testing.assert_array_equal(picture.data, residual - np.float32(0.1))
    assert picture.pixels[10, 10, 0] == 102
    assert picture.pixels[75, 15, 0] == 128
    assert "condition 12" in picture.note


def test_direction():
    """Lit from there."""
    pixels = draw_direction(np.float32([0, 1, 0]), View(100)).pixels
    assert pixels[20, 40].mean() > pixels[80, 40].mean() + 50
    assert draw_direction(np.zeros(3, np.float32), View(100)).pixels.size


@pytest.mark.parametrize(("radiance", "shown"), [(100.0, 0.25), (0.1, 0.1)])
def test_environment(radiance, shown):
    """Its mean is shown at a quarter of white, linear; a dim one is shown as it is."""
    picture = draw_environment(Environment(np.full((2, 4, 3), radiance, np.float32)), View())
    np.testing.assert_allclose(picture.pixels, encode_srgb(np.float32([shown]))[0] * 255, atol=0.51)
