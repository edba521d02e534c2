"""Spherical-harmonic light: the basis, the fit, and fits that have too little to go on."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from graphface import GraphfaceWarning
from graphface.nodes.sh import ambient, basis, fit, render
from graphface.nodes.types import Lighting


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
        found = fit(shading, NORMALS, EVERYWHERE, order=order, ridge=1e-9)
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
        """A coloured shading is fitted channel by channel."""
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
