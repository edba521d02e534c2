"""What every method of scattering promises: smooth, on the surface only, and nothing where light did not change."""

from __future__ import annotations

import numpy as np
import pytest
from shapes import eyes_apart, surface_with

from graphface.nodes.color import decode_srgb
from graphface.nodes.scatter.gaussian import gaussian
from graphface.nodes.scatter.screen_space import screen_space
from graphface.nodes.scatter.smoothed_change import smoothed_change
from graphface.nodes.types import (
    Image,
    Scene,
)

METHODS = [gaussian, screen_space]


class TestEveryMethod:
    @pytest.mark.parametrize("method", METHODS)
    def test_softens_an_edge(self, case, method):
        """The steepest step gets smaller."""
        soft, sharp = case.scattered(method, case.step)[:, :60, 0], case.step[:, :60]
        assert np.abs(np.diff(soft, axis=1)).max() < 0.7 * np.abs(np.diff(sharp, axis=1)).max()

    @pytest.mark.parametrize("method", METHODS)
    @pytest.mark.parametrize("encoding", ["srgb", "linear"])
    def test_unchanged_light_stays(self, case, method, encoding):
        """The photo already contains the scattering of its own light."""
        soft = case.scattered(method, case.old, photo=Image(case.photo.pixels, encoding=encoding))
        np.testing.assert_allclose(soft, np.broadcast_to(case.old[..., None], soft.shape), atol=1e-4)

    @pytest.mark.parametrize("method", METHODS)
    def test_nothing_leaks_over_the_silhouette(self, case, method):
        """An even light on the surface stays even up to its edge, and off it there is none."""
        soft = case.scattered(method, 0.8 * case.surface.coverage)
        np.testing.assert_allclose(soft[:, :70], 0.8, atol=1e-3)
        assert not soft[:, 70:].any()

    @pytest.mark.parametrize("method", METHODS)
    def test_light_is_kept(self, case, method):
        """Far from any border, the sum of linear light does not change."""
        spot = case.old.copy()
        spot[28:32, 28:32] += 1
        after = case.scattered(method, spot, 0.03)[..., 0]
        assert float(after.sum()) == pytest.approx(float(spot.sum()), rel=1e-3)

    @pytest.mark.parametrize("method", METHODS)
    @pytest.mark.parametrize("unit", [0.0, 0.5, 3.0, 40.0, 4000.0])
    @pytest.mark.parametrize("radius", [0.0, 0.01, 0.3, 1.0])
    def test_any_radius_and_size_of_face(self, case, method, unit, radius):
        """Less than a pixel, wider than the picture: finite, not negative, no brighter than the brightest."""
        soft = method(case.step, case.old, case.surface, eyes_apart(unit), case.photo, Scene(scatter=radius))
        assert np.isfinite(soft).all()
        assert soft.min() >= 0
        assert soft.max() <= 0.8 + 1e-3

    @pytest.mark.parametrize("method", METHODS)
    def test_one_pixel(self, method):
        """1 x 1 works like any other."""
        one = np.ones((1, 1), np.float32)
        spot = surface_with(np.float32([[[0, 0, 1]]]))
        photo = Image(np.zeros((1, 1, 3), np.float32))
        soft = method(one * 0.5, one * 0.2, spot, eyes_apart(40), photo, Scene(scatter=0.1))
        np.testing.assert_allclose(decode_srgb(np.float32(soft)), decode_srgb(np.full_like(soft, 0.5)), rtol=1e-3)


class TestSmoothedChange:
    def test_smoothing_nothing_changes_nothing(self, case):
        """The shading comes back, at any resolution of the grid."""
        same = lambda change, coverage, depth, resolution: change  # noqa: E731
        for unit in (10, 1000):
            found = smoothed_change(case.step, case.old, case.surface, eyes_apart(unit), case.photo, same)
            np.testing.assert_allclose(found, case.step, atol=1e-6)

    def test_without_a_surface_the_shading_is_returned(self, case):
        """The same object."""
        nowhere = surface_with(np.zeros_like(case.surface.normals))
        assert smoothed_change(case.step, case.old, nowhere, case.landmarks, case.photo, None) is case.step
