"""The real spherical harmonics, in (l, m) order with the constants of Ramamoorthi and Hanrahan 2001; their rotation."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.types import FloatArray, Lighting, Normals


def basis(normals: NDArray[np.floating[Any]], order: int) -> NDArray[np.floating[Any]]:
    """Y_lm of unit vectors (n, 3), columns in (l, m) order: (n, (order + 1)^2), in the dtype of `normals`."""
    x, y, z = normals[:, 0], normals[:, 1], normals[:, 2]
    columns = [np.full_like(x, 0.282095)]
    if order >= 1:
        columns += [0.488603 * y, 0.488603 * z, 0.488603 * x]
    if order >= 2:
        columns += [
            1.092548 * x * y,
            1.092548 * y * z,
            0.315392 * (3 * z * z - 1),
            1.092548 * x * z,
            0.546274 * (x * x - y * y),
        ]
    if order >= 3:
        columns += [
            0.590044 * y * (3 * x * x - y * y),
            2.890611 * x * y * z,
            0.457046 * y * (5 * z * z - 1),
            0.373176 * z * (5 * z * z - 3),
            0.457046 * x * (5 * z * z - 1),
            1.445306 * z * (x * x - y * y),
            0.590044 * x * (x * x - 3 * y * y),
        ]
    return np.stack(columns, axis=1)


def has_surface(normals: Normals) -> NDArray[np.bool_]:
    """Where a normal map holds a surface, H x W (several times faster than `any` over so short an axis)."""
    x, y, z = normals[..., 0], normals[..., 1], normals[..., 2]
    surface: NDArray[np.bool_] = (x != 0) | (y != 0) | (z != 0)
    return surface


def ambient(irradiance: float | FloatArray, order: int = 0) -> Lighting:
    """The light that gives every normal the same irradiance (a number, or one per channel)."""
    value = np.asarray(irradiance, np.float32)
    coefficients = np.zeros(((order + 1) ** 2, *value.shape), np.float32)
    coefficients[0] = value / 0.282095
    return Lighting(coefficients)


def sphere_points(count: int) -> NDArray[np.float64]:
    """Unit vectors (count, 3) spread evenly over the sphere along a golden-angle spiral."""
    index = np.arange(count) + 0.5
    y = 1 - 2 * index / count
    ring, turn = np.sqrt(np.maximum(1 - y * y, 0)), np.pi * (1 + np.sqrt(5)) * index
    return np.stack([ring * np.cos(turn), y, ring * np.sin(turn)], axis=1)


def rotated(light: Lighting, azimuth: float = 0.0, elevation: float = 0.0, roll: float = 0.0) -> Lighting:
    """A light turned around the face, angles in degrees; see `sh.rotate`."""
    turn = rotation_matrix(azimuth, elevation, roll)
    return Lighting((_harmonic_rotation(turn, light.order) @ light.coefficients).astype(np.float32))


def rotation_matrix(azimuth: float, elevation: float, roll: float = 0.0) -> NDArray[np.float64]:
    """3 x 3: takes the direction of a light (x right, y up, z towards the viewer) to where it comes from afterwards."""
    a, e, r = np.radians([azimuth, elevation, roll])
    about_y = np.array([[np.cos(a), 0, np.sin(a)], [0, 1, 0], [-np.sin(a), 0, np.cos(a)]])
    about_x = np.array([[1, 0, 0], [0, np.cos(e), np.sin(e)], [0, -np.sin(e), np.cos(e)]])
    about_z = np.array([[np.cos(r), -np.sin(r), 0], [np.sin(r), np.cos(r), 0], [0, 0, 1]])
    turned: NDArray[np.float64] = about_y @ about_x @ about_z
    return turned


def _harmonic_rotation(turn: NDArray[np.float64], order: int) -> NDArray[np.float64]:
    """The matrix of a rotation on coefficients, by interpolation: a turned harmonic of order l is again one of order l,
    so least squares at more points than coefficients is exact (recurrences buy speed that a 16 x 16 matrix needs not).
    """
    points = sphere_points(64)
    matrix: NDArray[np.float64] = np.linalg.lstsq(basis(points, order), basis(points @ turn, order), rcond=None)[0]
    return matrix
