"""Lamps: what may be written of them, and what excludes each other."""

from __future__ import annotations

import pytest

from graphface.nodes.types import (
    DirectionalLight,
    PointLight,
    Scene,
)


class TestColor:
    def test_color_and_kelvin_exclude_each_other(self):
        """Two colors for one light are a mistake."""
        with pytest.raises(ValueError, match="not both"):
            DirectionalLight(color=(1, 0, 0), kelvin=3000)

    def test_a_warm_light_is_colored(self):
        """Only then has the shading three channels."""
        assert Scene(lights=(DirectionalLight(kelvin=3000),)).colored
        assert not Scene(lights=(DirectionalLight(kelvin=6500),)).colored


class TestPointLight:
    def test_position_and_angles_exclude_each_other(self):
        """Two places for one lamp are a mistake."""
        with pytest.raises(ValueError, match="not both"):
            PointLight(position=(0, 0, 3), azimuth=10)
        with pytest.raises(ValueError, match="not both"):
            PointLight(position=(0, 0, 3), distance=3)


class TestScene:
    def test_unchanged(self):
        """What is the photo's own light whatever the photo."""
        light = DirectionalLight()
        assert Scene(mode="add").unchanged
        assert Scene(mode="mix", mix=0, lights=(light,)).unchanged
        assert Scene(mode="add", lights=(DirectionalLight(intensity=0),)).unchanged
        assert not Scene(mode="add", lights=(light,)).unchanged
        assert not Scene().unchanged

    def test_the_light_from_behind_casts_no_shadow(self):
        """It only grazes what the camera sees."""
        assert not Scene(lights=(DirectionalLight(azimuth=180),)).casting
        assert Scene(lights=(DirectionalLight(azimuth=90),)).casting
        assert not Scene(lights=(PointLight(position=(0, 0, -3)),)).casting
