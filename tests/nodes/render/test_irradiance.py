"""The irradiance of every kind of light."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from shapes import half_ball

from graphface import UsageError
from graphface.nodes.render.irradiance import irradiance
from graphface.nodes.types import (
    DirectionalLight,
    EnvironmentLight,
    Lighting,
    PointLight,
    Scene,
    SpotLight,
)

NORMALS = half_ball(31)
NORMALS = NORMALS[NORMALS.any(axis=2)]


FRONT = np.float32([[0, 0, 1]])


def received(light, point=(0, 0, 0), normal=(0, 0, 1)):
    scene = Scene(lights=(light,))
    return float(irradiance(scene, np.float32([normal]), np.float32([point]))[0])


class TestDirectionalLight:
    def test_a_facing_surface_receives_the_intensity(self):
        """A light of intensity 2 head-on gives 2, whatever its size."""
        for size in (0, 15, 60):
            scene = Scene(lights=(DirectionalLight(intensity=2, size=size),))
            assert irradiance(scene, FRONT) == pytest.approx(2, rel=1e-5)

    def test_a_point_light_is_lamberts_cosine(self):
        """Without size: max(0, cos)."""
        scene = Scene(lights=(DirectionalLight(azimuth=60, size=0),))
        expected = np.maximum(NORMALS @ scene.lights[0].towards, 0)
        np.testing.assert_allclose(irradiance(scene, NORMALS), expected, atol=1e-4)

    def test_size_rounds_the_terminator(self):
        """A large light reaches a little beyond grazing, continuously and monotone in the cosine."""
        cosine = np.linspace(-1, 1, 2001, dtype=np.float32)
        normals = np.stack([cosine, 0 * cosine, np.sqrt(1 - cosine**2)], axis=1)
        received = irradiance(Scene(lights=(DirectionalLight(azimuth=90, size=30),)), normals)
        assert received[1000] > 0
        assert received[0] == 0
        steps = np.diff(received)
        assert steps.min() >= 0
        assert steps.max() < 2e-3

    def test_two_half_lights_are_one(self):
        """Light adds up."""
        half = DirectionalLight(azimuth=30, intensity=0.5)
        whole = DirectionalLight(azimuth=30, intensity=1)
        np.testing.assert_allclose(
            irradiance(Scene(lights=(half, half)), NORMALS),
            irradiance(Scene(lights=(whole,)), NORMALS),
            rtol=1e-5,
        )

    def test_colored_light_shades_three_channels(self):
        """Red light leaves green and blue dark."""
        received = irradiance(Scene(lights=(DirectionalLight(color=(1, 0, 0)),)), FRONT)
        np.testing.assert_allclose(received, [[1, 0, 0]], atol=1e-6)


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


class TestEnvironmentLight:
    SCENE = Scene(lights=(EnvironmentLight(azimuth=90),))

    def test_is_rotated(self):
        """Light from the viewer, turned by 90 degrees, comes from the picture's right."""
        panorama = Lighting(np.repeat(np.float32([[1], [0], [1], [0]]), 3, axis=1))
        front, right = irradiance(self.SCENE, np.float32([[0, 0, 1], [1, 0, 0]]), panorama=panorama)
        assert (right > 2 * front).all()

    def test_needs_a_panorama(self):
        """Without one the error names the input."""
        with pytest.raises(UsageError, match="environment"):
            irradiance(self.SCENE, FRONT)


class TestVisible:
    def test_scales_its_own_light(self):
        """The share of one light leaves the other alone."""
        scene = Scene(lights=(DirectionalLight(), DirectionalLight(intensity=2)))
        assert irradiance(scene, FRONT, visible={1: np.float32([0.25])})[0] == pytest.approx(1 + 0.5)
