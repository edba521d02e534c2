"""The spherical harmonics: orthonormal, and rotated without loss."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from graphface.nodes.harmonics import ambient, basis, has_surface, rotated, rotation_matrix, sphere_points
from graphface.nodes.types import Lighting


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


class TestHasSurface:
    def test_any_component_counts(self):
        """A normal along any axis, in any direction, is a surface; zero is none."""
        normals = np.zeros((1, 7, 3), np.float32)
        normals[0, :3], normals[0, 3:6] = np.eye(3), -np.eye(3)
        np.testing.assert_array_equal(has_surface(normals)[0], [True] * 6 + [False])


class TestAmbient:
    @pytest.mark.parametrize("order", [0, 1, 2, 3])
    def test_is_the_same_for_every_normal(self, order):
        """Its irradiance, one per channel, whatever the order."""
        light = ambient(np.float32([0.2, 0.4, 0.9]), order)
        np.testing.assert_allclose(
            basis(sphere_points(20), order) @ light.coefficients, [[0.2, 0.4, 0.9]] * 20, rtol=1e-6
        )


class TestSpherePoints:
    @pytest.mark.parametrize("count", [1, 2, 64, 600])
    def test_are_spread_evenly(self, count):
        """Unit vectors; for more than a few, every direction is near one of them."""
        points = sphere_points(count)
        np.testing.assert_allclose(np.linalg.norm(points, axis=1), 1)
        if count > 60:
            nearest = (sphere_points(5000) @ points.T).max(axis=1)
            assert np.degrees(np.arccos(nearest.min())) < 180 / np.sqrt(count)


class TestRotated:
    @settings(max_examples=40, deadline=None)
    @given(st.floats(-180, 180), st.floats(-90, 90), st.floats(-180, 180), st.integers(0, 3))
    def test_light_of_a_rotated_normal(self, azimuth, elevation, roll, order):
        """A rotated light gives a rotated normal what the light gave the normal."""
        light = Lighting(np.linspace(-1, 2, (order + 1) ** 2).astype(np.float32))
        normals, rotation = sphere_points(30), rotation_matrix(azimuth, elevation, roll)
        after = basis(normals @ rotation.T, order) @ rotated(light, azimuth, elevation, roll).coefficients
        np.testing.assert_allclose(after, basis(normals, order) @ light.coefficients, atol=1e-5)
