"""The light behind a shading: found again, and bounded where there is too little to go on."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from shapes import half_ball

from graphface import GraphfaceWarning
from graphface.nodes.harmonics import ambient, basis, sphere_points
from graphface.nodes.sh.fit import dominant_direction, fit
from graphface.nodes.sh.render import render
from graphface.nodes.types import Lighting

NORMALS = half_ball()
EVERYWHERE = np.ones(NORMALS.shape[:2], np.float32)


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
        """A flat wall determines no direction: the constant term takes all."""
        wall = np.zeros_like(NORMALS)
        wall[..., 2] = 1
        with pytest.warns(GraphfaceWarning, match="hardly differ"):
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
        """A colored shading gives (n, 3) coefficients, or (n,) with `grey`."""
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
