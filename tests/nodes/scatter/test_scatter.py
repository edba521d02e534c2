"""Scattering: smooth, within the silhouette, and nothing where light did not change."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from graphface.nodes.color import decode_srgb
from graphface.nodes.scatter.gaussian import gaussian
from graphface.nodes.scatter.none import none
from graphface.nodes.scatter.screen_space import screen_space
from graphface.nodes.types import Image, Landmarks, Scene, Surface

HEIGHT, WIDTH, UNIT = 60, 80, 40.0
METHODS = [gaussian, screen_space]


def landmarks(unit=UNIT):
    points = np.zeros((468, 3), np.float32)
    points[263, 0] = unit
    return Landmarks(points, "facemesh468")


def surface(depth=None):
    """Covers all but the last ten columns."""
    coverage = np.ones((HEIGHT, WIDTH), np.float32)
    coverage[:, -10:] = 0
    depth = np.ones((HEIGHT, WIDTH), np.float32) if depth is None else depth
    normals = np.zeros((HEIGHT, WIDTH, 3), np.float32)
    normals[..., 2] = coverage
    return Surface(normals, depth, coverage, np.zeros((HEIGHT, WIDTH), np.int32), np.zeros_like(normals))


def step():
    """Light left of the middle, off the surface none."""
    values = np.full((HEIGHT, WIDTH), 0.2, np.float32)
    values[:, : WIDTH // 2] = 0.8
    return values * surface().coverage


OLD = np.full((HEIGHT, WIDTH), 0.5, np.float32) * surface().coverage
PHOTO = Image(np.zeros((HEIGHT, WIDTH, 3), np.float32), encoding="linear")


def scattered(method, shading, radius=0.05, on=None, photo=PHOTO):
    return method(shading, OLD, on or surface(), landmarks(), photo, Scene(scatter=radius))


class TestScatter:
    @pytest.mark.parametrize("method", METHODS)
    def test_softens_an_edge(self, method):
        """The steepest step gets smaller, in every method."""
        soft = scattered(method, step()).reshape(HEIGHT, WIDTH, -1)[..., 0]
        inside = np.s_[:, :60]
        assert np.abs(np.diff(soft[inside], axis=1)).max() < 0.7 * np.abs(np.diff(step()[inside], axis=1)).max()

    @pytest.mark.parametrize("method", METHODS)
    @pytest.mark.parametrize("encoding", ["srgb", "linear"])
    def test_unchanged_light_stays(self, method, encoding):
        """What the photo's own light did beneath the skin is in the photo already."""
        photo = Image(PHOTO.pixels, encoding=encoding)
        soft = scattered(method, OLD, photo=photo).reshape(HEIGHT, WIDTH, -1)
        np.testing.assert_allclose(soft, np.broadcast_to(OLD[..., None], soft.shape), atol=1e-4)

    @pytest.mark.parametrize("method", METHODS)
    def test_nothing_leaks_over_the_silhouette(self, method):
        """An even light on the surface stays even up to its edge, and off it there is none."""
        even = 0.8 * surface().coverage
        soft = scattered(method, even).reshape(HEIGHT, WIDTH, -1)
        np.testing.assert_allclose(soft[:, :70], 0.8, atol=1e-3)
        assert not soft[:, 70:].any()

    @pytest.mark.parametrize("method", METHODS)
    def test_light_is_kept(self, method):
        """Far from any border, the sum of linear light does not change."""
        spot = OLD.copy()
        spot[28:32, 28:32] += 1
        before, after = (
            float(v.reshape(HEIGHT, WIDTH, -1)[..., 0].sum()) for v in (spot, scattered(method, spot, 0.03))
        )
        assert after == pytest.approx(before, rel=1e-3)

    def test_red_travels_furthest(self):
        """The dark side of an edge turns warm."""
        soft = scattered(screen_space, step(), 0.1)
        beside = soft[30, WIDTH // 2 + 3]
        assert beside[0] > beside[1] >= beside[2] - 1e-6

    def test_depth_stops_light(self):
        """A step in depth as large as the radius keeps the edge sharp."""
        depth = np.ones((HEIGHT, WIDTH), np.float32)
        depth[:, WIDTH // 2 :] = -40
        soft = scattered(screen_space, step(), 0.1, surface(depth))
        np.testing.assert_allclose(soft[:, :70, 0], step()[:, :70], atol=1e-3)

    def test_none_is_none(self):
        """The same object."""
        values = step()
        assert scattered(none, values) is values

    @settings(max_examples=30, deadline=None)
    @given(st.floats(0, 1), st.sampled_from([0.0, 0.5, 3.0, 40.0, 4000.0]), st.sampled_from(METHODS))
    def test_any_radius_and_size_of_face(self, radius, unit, method):
        """Less than a pixel, wider than the picture: finite, not negative, no brighter than the brightest."""
        soft = method(step(), OLD, surface(), landmarks(unit), PHOTO, Scene(scatter=radius))
        assert np.isfinite(soft).all()
        assert soft.min() >= 0
        assert soft.max() <= 0.8 + 1e-3

    @pytest.mark.parametrize("method", METHODS)
    def test_one_pixel(self, method):
        """1 x 1 works like any other."""
        one = np.ones((1, 1), np.float32)
        spot = Surface(np.float32([[[0, 0, 1]]]), one, one, np.zeros((1, 1), np.int32), np.zeros((1, 1, 3), np.float32))
        photo = Image(np.zeros((1, 1, 3), np.float32))
        soft = method(one * 0.5, one * 0.2, spot, landmarks(), photo, Scene(scatter=0.1))
        np.testing.assert_allclose(decode_srgb(np.float32(soft)), decode_srgb(np.full_like(soft, 0.5)), rtol=1e-3)
