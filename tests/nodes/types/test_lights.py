"""Lamps: color by temperature, places, fall-off and cones."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from graphface.nodes.render.irradiance import irradiance
from graphface.nodes.temperature import kelvin_color
from graphface.nodes.types import DirectionalLight, PointLight, Scene, SpotLight

FRONT = np.float32([[0, 0, 1]])


def received(light, point=(0, 0, 0), normal=(0, 0, 1)):
    scene = Scene(lights=(light,))
    return float(irradiance(scene, np.float32([normal]), np.float32([point]))[0])


class TestKelvin:
    def test_6500_is_white(self):
        """The neutral temperature changes no color."""
        np.testing.assert_allclose(kelvin_color(6500), 1, rtol=1e-6)

    @given(st.floats(1667, 24999))
    def test_warmer_is_redder(self, kelvin):
        """Red over blue falls with temperature; luminance stays 1, nothing is negative."""
        red, green, blue = kelvin_color(kelvin)
        hotter = kelvin_color(kelvin + 1)
        assert min(red, green, blue) >= 0
        assert 0.2126 * red + 0.7152 * green + 0.0722 * blue == pytest.approx(1, rel=1e-5)
        assert red * hotter[2] >= hotter[0] * blue * (1 - 1e-3)

    def test_color_and_kelvin_exclude_each_other(self):
        """Two colors for one light are a mistake."""
        with pytest.raises(ValueError, match="not both"):
            DirectionalLight(color=(1, 0, 0), kelvin=3000)

    def test_a_warm_light_is_colored(self):
        """Only then has the shading three channels."""
        assert Scene(lights=(DirectionalLight(kelvin=3000),)).colored
        assert not Scene(lights=(DirectionalLight(kelvin=6500),)).colored


class TestPointLight:
    def test_intensity_is_what_the_middle_of_the_face_gets(self):
        """Whatever the distance."""
        for distance in (1, 4, 50):
            assert received(PointLight(distance=distance, intensity=3, size=0)) == pytest.approx(3, rel=1e-4)

    def test_inverse_square(self):
        """Half as far from the lamp, four times the light; with falloff 0 the same."""
        assert received(PointLight(distance=4, size=0), (0, 0, 2)) == pytest.approx(4, rel=1e-4)
        assert received(PointLight(distance=4, size=0, falloff=0), (0, 0, 2)) == pytest.approx(1, rel=1e-4)

    def test_a_far_lamp_is_the_sun(self):
        """At a thousand eye distances a lamp and a directional light agree."""
        lamp, sun = (
            k(azimuth=40, elevation=10, size=5, **e)
            for k, e in ((PointLight, {"distance": 1000}), (DirectionalLight, {}))
        )
        assert received(lamp, (0.5, 0.3, 0.2)) == pytest.approx(received(sun), rel=1e-2)

    @given(st.tuples(*[st.floats(-2, 2)] * 3), st.tuples(*[st.floats(-2, 2)] * 3))
    def test_nowhere_infinite(self, place, point):
        """A lamp at, in or behind the face stays finite."""
        value = received(PointLight(position=place), point)
        assert np.isfinite(value)
        assert value >= 0

    def test_position_and_angles_exclude_each_other(self):
        """Two places for one lamp are a mistake."""
        with pytest.raises(ValueError, match="not both"):
            PointLight(position=(0, 0, 3), azimuth=10)
        with pytest.raises(ValueError, match="not both"):
            PointLight(position=(0, 0, 3), distance=3)


class TestSpotLight:
    SPOT = SpotLight(distance=4, cone=10, penumbra=5, size=0, falloff=0)

    def test_full_within_the_cone_and_none_outside(self):
        """Angles are from the axis."""
        at = lambda degrees: (4 * np.tan(np.radians(degrees)), 0, 0)  # noqa: E731
        lit = [received(self.SPOT, at(d)) / max(np.cos(np.radians(d)), 1e-3) for d in (0, 9, 12.5, 15.5)]
        assert lit[0] == pytest.approx(1, rel=1e-3)
        assert lit[1] == pytest.approx(1, rel=1e-3)
        assert 0.2 < lit[2] < 0.8
        assert lit[3] == 0

    def test_a_target_turns_it(self):
        """Pointed elsewhere, the middle of the face is dark."""
        assert received(self.SPOT.model_copy(update={"target": (3.0, 0.0, 0.0)})) == 0

    def test_target_at_the_lamp(self):
        """No axis at all: it shines straight ahead, and nothing is divided by 0."""
        assert np.isfinite(received(SpotLight(position=(0, 0, 3), target=(0, 0, 3))))


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
