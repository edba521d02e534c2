"""Spherical-harmonic light: the basis, the fit, and fits that have too little to go on."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from graphface import GraphfaceWarning
from graphface.nodes.environment import directions, solid_angles
from graphface.nodes.harmonics import ambient, basis, sphere_points
from graphface.nodes.sh.ball import ball
from graphface.nodes.sh.fit import dominant_direction, fit
from graphface.nodes.sh.from_environment import from_environment
from graphface.nodes.sh.render import render
from graphface.nodes.sh.rotate import rotate
from graphface.nodes.sh.to_environment import to_environment
from graphface.nodes.types import Environment, Lighting


def hemisphere(side=33):
    """The normals of a half ball seen from the front, H x W x 3; zero beside it."""
    y, x = np.mgrid[1 : -1 : side * 1j, -1 : 1 : side * 1j]
    squared = x * x + y * y
    normals = np.stack([x, y, np.sqrt(np.maximum(1 - squared, 0))], axis=2)
    normals[squared >= 1] = 0
    return normals.astype(np.float32)


NORMALS = hemisphere()
EVERYWHERE = np.ones(NORMALS.shape[:2], np.float32)


class TestBasis:
    @pytest.mark.parametrize("order", [0, 1, 2, 3])
    def test_is_orthonormal_on_the_sphere(self, order):
        """The Gram matrix over the sphere is the identity: the constants are right."""
        z, weights = np.polynomial.legendre.leggauss(16)
        angles = np.arange(32) * 2 * np.pi / 32
        ring = np.sqrt(1 - z * z)
        points = np.stack(
            [np.outer(ring, np.cos(angles)), np.outer(ring, np.sin(angles)), np.tile(z[:, None], 32)], axis=2
        ).reshape(-1, 3)
        values = basis(points, order)
        gram = (values * np.repeat(weights * 2 * np.pi / 32, 32)[:, None]).T @ values
        np.testing.assert_allclose(gram, np.eye((order + 1) ** 2), atol=1e-5)


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


class TestFit:
    @pytest.mark.parametrize("order", [0, 1, 2, 3])
    def test_recovers_a_light_of_its_own_order(self, order):
        """The light that made a shading is found again, up to the ridge."""
        coefficients = np.float32([4, 0.3, 0.5, -0.4, 0.1, 0.05, -0.1, 0.05, 0.1, *[0.03] * 7])[: (order + 1) ** 2]
        shading = render(Lighting(coefficients), NORMALS)
        found = fit(shading, NORMALS, EVERYWHERE, order=order, ridge=1e-9, robust="none")
        np.testing.assert_allclose(found.light.coefficients, coefficients, atol=1e-3)
        assert np.abs(found.residual).max() < 1e-4

    def test_ignores_what_the_mask_leaves_out(self):
        """Wild values under a zero mask change nothing."""
        shading = render(ambient(0.5, order=1), NORMALS)
        wild, mask = shading.copy(), EVERYWHERE.copy()
        wild[:, :10], mask[:, :10] = 100, 0
        found = fit(wild, NORMALS, mask).light.coefficients
        np.testing.assert_allclose(found, fit(shading, NORMALS, mask).light.coefficients)

    def test_one_light_per_channel(self):
        """A colored shading is fitted channel by channel."""
        colored = np.stack([render(ambient(v, order=1), NORMALS) for v in (0.9, 0.5, 0.1)], axis=2)
        light = fit(colored, NORMALS, EVERYWHERE).light
        np.testing.assert_allclose(render(light, NORMALS), colored, atol=1e-3)

    def test_reports_a_good_condition_for_a_half_ball(self):
        """First order on a hemisphere is well posed."""
        assert fit(EVERYWHERE, NORMALS, EVERYWHERE).condition < 20

    def test_empty_mask_gives_ambient_light_and_warns(self):
        """Nothing to fit: the mean shading as ambient light."""
        with pytest.warns(GraphfaceWarning, match="no pixel with a normal"):
            found = fit(EVERYWHERE * 0.4, NORMALS, EVERYWHERE * 0)
        np.testing.assert_allclose(render(found.light, NORMALS)[16, 16], 0.4, rtol=1e-5)

    def test_constant_normals_give_ambient_light_and_warn(self):
        """A flat wall says nothing about direction: the constant term takes all."""
        wall = np.zeros_like(NORMALS)
        wall[..., 2] = 1
        with pytest.warns(GraphfaceWarning, match="barely tell"):
            found = fit(EVERYWHERE * 0.6, wall, EVERYWHERE)
        np.testing.assert_allclose(render(found.light, NORMALS)[NORMALS.any(axis=2)], 0.6, atol=0.01)

    @settings(max_examples=50, deadline=None)
    @given(
        st.integers(0, 2**32 - 1),
        st.integers(1, 5),
        st.integers(0, 3),
        st.floats(0, 1, width=32),
        st.sampled_from([1e-6, 1e-3, 1.0]),
    )
    @pytest.mark.filterwarnings("ignore::graphface.fallback.GraphfaceWarning")
    def test_few_pixels_stay_bounded(self, seed, pixels, order, level, weight):
        """On a handful of pixels, any order: finite, and the shading that comes out is of the size that went in."""
        rng = np.random.default_rng(seed)
        covered = np.argwhere(NORMALS.any(axis=2))
        mask = np.zeros_like(EVERYWHERE)
        mask[tuple(covered[rng.integers(len(covered), size=pixels)].T)] = weight
        shading = (level * rng.uniform(0.9, 1.1, mask.shape)).astype(np.float32)
        found = fit(shading, NORMALS, mask, order=order)
        assert np.isfinite(found.light.coefficients).all()
        assert np.isfinite(found.condition)
        assert found.condition >= 0.99
        at_mask = render(found.light, NORMALS)[mask > 0]
        assert np.abs(at_mask - shading[mask > 0]).max() <= 0.3 * level + 1e-4


LIT = Lighting(np.float32([2.2, 0.5, 0.8, 0.9]))


def shadowed(share=0.25):
    """The shading of `LIT` with a band of cast shadow over a share of the ball."""
    shading = render(LIT, NORMALS)
    shading[: int(share * len(shading))] *= 0.2
    return shading


class TestRobustFit:
    """Fits that look past cast shadows and highlights."""

    @pytest.mark.parametrize("robust", ["huber", "trimmed"])
    def test_beats_least_squares_in_shadow(self, robust):
        """With a fifth of the ball in cast shadow the light is found more nearly."""

        def error(robust):
            found = fit(shadowed(0.22), NORMALS, EVERYWHERE, ridge=1e-9, robust=robust).light
            return np.abs(found.coefficients - LIT.coefficients).max()

        assert error(robust) < 0.6 * error("none")

    def test_is_the_default(self):
        """Every face has brows, eyes and lips, which no light explains."""
        found = fit(shadowed(0.1), NORMALS, EVERYWHERE, ridge=1e-9).light
        np.testing.assert_allclose(found.coefficients, LIT.coefficients, atol=1e-3)

    @pytest.mark.parametrize("robust", ["huber", "trimmed"])
    def test_agrees_where_nothing_is_wrong(self, robust):
        """On a shading that a light explains there is nothing to look past."""
        plain, careful = (
            fit(render(LIT, NORMALS), NORMALS, EVERYWHERE, robust=r).light.coefficients for r in ("none", robust)
        )
        np.testing.assert_allclose(careful, plain, atol=2e-2)

    @settings(max_examples=40, deadline=None)
    @given(st.integers(0, 2**32 - 1), st.sampled_from(["huber", "trimmed"]), st.integers(0, 3), st.integers(1, 30))
    def test_bounded_on_any_shading(self, seed, robust, order, pixels):
        """However few pixels and however wild, coefficients stay within what the ridge allows."""
        rng = np.random.default_rng(seed)
        mask = np.zeros(EVERYWHERE.shape, np.float32)
        rows, columns = np.nonzero(NORMALS.any(axis=2))
        picked = rng.choice(len(rows), pixels)
        mask[rows[picked], columns[picked]] = 1
        found = fit(rng.random(mask.shape).astype(np.float32), NORMALS, mask, order=order, robust=robust)
        assert np.abs(found.light.coefficients).max() < 400


class TestNonnegativeFit:
    """Light is not negative, whatever the polynomial would like."""

    @settings(max_examples=40, deadline=None)
    @given(st.integers(0, 2**32 - 1), st.integers(0, 3))
    def test_no_direction_receives_negative_light(self, seed, order):
        """At every direction at least minus five percent of the mean."""
        shading = np.random.default_rng(seed).random(EVERYWHERE.shape).astype(np.float32) ** 4
        light = fit(shading * (NORMALS[..., 0] > 0.3), NORMALS, EVERYWHERE, order=order, nonnegative=True).light
        values = basis(sphere_points(2000), order) @ light.coefficients
        assert values.min() >= -0.05 * max(values.mean(), 1e-3)

    def test_an_admissible_fit_is_left_alone(self):
        """Where nothing is negative the bound changes nothing."""
        shading = render(ambient(0.5, order=1), NORMALS)
        one, other = (fit(shading, NORMALS, EVERYWHERE, nonnegative=n).light.coefficients for n in (False, True))
        np.testing.assert_array_equal(one, other)


class TestChannels:
    def test_grey_makes_one_light_of_three(self):
        """A colored shading gives (n, 3) coefficients, or (n,) where grey is asked for."""
        colored = render(ambient(np.float32([0.2, 0.4, 0.9])), NORMALS)
        assert fit(colored, NORMALS, EVERYWHERE).light.coefficients.shape == (4, 3)
        grey = fit(colored, NORMALS, EVERYWHERE, grey=True).light.coefficients
        np.testing.assert_allclose(grey[0], 0.5 / 0.282095, rtol=1e-3)


class TestDirection:
    def test_points_to_the_light(self):
        """A single light's direction comes back."""
        towards = np.float32([0.6, 0.3, 0.74])
        towards /= np.linalg.norm(towards)
        shading = np.maximum(NORMALS @ towards, 0)
        found = fit(shading, NORMALS, EVERYWHERE).direction
        assert np.degrees(np.arccos(min(1.0, float(found @ towards)))) < 10

    def test_even_light_has_none(self):
        """Ambient light gives the zero vector, not a direction made of rounding."""
        assert not dominant_direction(ambient(0.7, order=2)).any()


class TestRotate:
    @settings(max_examples=40, deadline=None)
    @given(st.floats(-180, 180), st.floats(-90, 90), st.floats(-180, 180), st.integers(0, 3))
    def test_keeps_the_power_of_each_order(self, azimuth, elevation, roll, order):
        """Turning a light mixes coefficients within an order and never changes their sum of squares."""
        light = Lighting(np.linspace(-1, 2, (order + 1) ** 2).astype(np.float32))
        turned = rotate(light, azimuth=azimuth, elevation=elevation, roll=roll).coefficients
        for one in range(order + 1):
            part = slice(one * one, (one + 1) ** 2)
            before, after = (float(np.square(c[part]).sum()) for c in (light.coefficients, turned))
            assert after == pytest.approx(before, rel=1e-4, abs=1e-5)

    def test_signs_of_the_angles(self):
        """Azimuth turns the viewer's light to the picture's right, elevation upwards."""
        frontal = Lighting(np.float32([1, 0, 1, 0]))
        np.testing.assert_allclose(dominant_direction(rotate(frontal, azimuth=90)), [1, 0, 0], atol=1e-6)
        np.testing.assert_allclose(dominant_direction(rotate(frontal, elevation=90)), [0, 1, 0], atol=1e-6)
        np.testing.assert_allclose(
            dominant_direction(rotate(Lighting(np.float32([1, 0, 0, 1])), roll=90)), [0, 1, 0], atol=1e-6
        )


class TestEnvironment:
    def test_even_panorama_is_ambient(self):
        """Radiance 1 from everywhere is shading 1."""
        light = from_environment(Environment(np.ones((32, 64, 3), np.float32)))
        np.testing.assert_allclose(light.coefficients, ambient(np.ones(3, np.float32), 2).coefficients, atol=2e-3)

    def test_there_and_back(self):
        """A light's smoothest panorama gives the light again."""
        light = Lighting(np.float32([2.5, 0.3, 0.4, -0.3, 0.05, 0.02, 0.04, 0.03, -0.05]))
        again = from_environment(to_environment(light, height=128, quantity="radiance"))
        np.testing.assert_allclose(again.coefficients[:, 1], light.coefficients, atol=2e-3)

    def test_a_patch_lights_from_its_side(self):
        """The middle column is before the face; a quarter of the width is to the picture's right."""
        for column, expected in ((32, (0, 0, 1)), (16, (1, 0, 0)), (48, (-1, 0, 0))):
            radiance = np.zeros((32, 64, 3), np.float32)
            radiance[15:17, column - 1 : column + 1] = 100
            found = dominant_direction(from_environment(Environment(radiance)))
            np.testing.assert_allclose(found, expected, atol=0.02)

    @settings(max_examples=20, deadline=None)
    @given(st.integers(1, 40), st.integers(1, 40))
    def test_pixels_tile_the_sphere(self, height, width):
        """Solid angles sum to 4 pi, directions are unit vectors, whatever the size."""
        assert solid_angles(height, width).sum() == pytest.approx(4 * np.pi)
        np.testing.assert_allclose(np.linalg.norm(directions(height, width), axis=2), 1, atol=1e-12)


class TestBall:
    def test_shows_the_light_where_it_comes_from(self):
        """Lit from the right, the ball's right is brighter; around it there is nothing."""
        picture = ball(Lighting(np.float32([1, 0, 0, 0.5])), size=64)
        assert picture.pixels[32, 52].mean() > picture.pixels[32, 12].mean() + 0.1
        assert picture.alpha is not None
        assert picture.alpha[0, 0] == 0
        assert picture.alpha[32, 32] == 1
