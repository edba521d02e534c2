"""The real spherical harmonics Y_lm of unit vectors, in (l, m) order, and their rotation.

Orders 0 to 2 have the constants of Ramamoorthi and Hanrahan, An Efficient Representation for Irradiance Environment
Maps, SIGGRAPH 2001, equation 3; order 3 continues them with the same normalization and signs. In the camera frame
(x right, y up, z towards the viewer) the first four are: constant, y, z, x.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.types import FloatArray, Lighting, Normals

Y_0 = 0.282095
"""Y_00."""


Y_1 = 0.488603
"""Y_1m over the coordinate that it is proportional to: y, z and x for m = -1, 0 and 1."""


def basis(normals: NDArray[np.floating[Any]], order: int) -> NDArray[np.floating[Any]]:
    """The harmonics of unit vectors.

    Args:
        normals: (n, 3) unit length.
        order: highest l, 0 to 3.

    Returns:
        (n, (order + 1)^2) in the dtype of `normals`, columns in (l, m) order.

    >>> basis(np.array([[0.0, 0.0, 1.0]]), 2).round(3) + 0
    array([[0.282, 0.   , 0.489, 0.   , 0.   , 0.   , 0.631, 0.   , 0.   ]])
    """
    x, y, z = normals[:, 0], normals[:, 1], normals[:, 2]
    columns = [np.full_like(x, Y_0)]
    if order >= 1:
        columns += [Y_1 * y, Y_1 * z, Y_1 * x]
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
    """Where a normal map H x W x 3 is not zero: bool H x W.

    `(normals != 0).any(axis=2)` takes several times as long, because the axis is so short.
    """
    x, y, z = normals[..., 0], normals[..., 1], normals[..., 2]
    surface: NDArray[np.bool_] = (x != 0) | (y != 0) | (z != 0)
    return surface


def ambient(irradiance: float | FloatArray, order: int = 0) -> Lighting:
    """The light that gives every normal the same irradiance: a number, or float32 (3,) with one for each channel.

    >>> light = ambient(0.5, order=1)
    >>> (basis(np.array([[0.0, 0.6, 0.8]]), 1) @ light.coefficients).round(4)
    array([0.5])
    """
    value = np.asarray(irradiance, np.float32)
    coefficients = np.zeros(((order + 1) ** 2, *value.shape), np.float32)
    coefficients[0] = value / Y_0
    return Lighting(coefficients)


def sphere_points(count: int) -> NDArray[np.float64]:
    """Unit vectors (count, 3), spread evenly over the sphere along a golden-angle spiral about y.

    >>> bool(np.abs(sphere_points(1000).mean(axis=0)).max() < 1e-3)
    True
    """
    index = np.arange(count) + 0.5
    y = 1 - 2 * index / count
    radius, angle = np.sqrt(np.maximum(1 - y * y, 0)), np.pi * (1 + np.sqrt(5)) * index
    return np.stack([radius * np.cos(angle), y, radius * np.sin(angle)], axis=1)


def rotated(light: Lighting, azimuth: float = 0.0, elevation: float = 0.0, roll: float = 0.0) -> Lighting:
    """A light turned around the face by `rotation_matrix`, angles in degrees.

    >>> frontal = Lighting(np.float32([1, 0, 1, 0]))
    >>> rotated(frontal, azimuth=90).coefficients.round(3) + 0  # now from the picture's right, +x
    array([1., 0., 0., 1.], dtype=float32)
    """
    rotation = rotation_matrix(azimuth, elevation, roll)
    return Lighting((_coefficient_rotation(rotation, light.order) @ light.coefficients).astype(np.float32))


def rotation_matrix(azimuth: float, elevation: float, roll: float = 0.0) -> NDArray[np.float64]:
    """3 x 3 rotation of light directions in the camera frame: first `roll`, then `elevation`, then `azimuth`.

    Args:
        azimuth: degrees about the y axis, positive to the picture's right.
        elevation: degrees about the x axis, positive upwards.
        roll: degrees about the viewing axis, positive counter-clockwise in the picture.

    >>> (rotation_matrix(90, 0) @ [0, 0, 1]).round(3) + 0
    array([1., 0., 0.])
    """
    a, e, r = np.radians([azimuth, elevation, roll])
    about_y = np.array([[np.cos(a), 0, np.sin(a)], [0, 1, 0], [-np.sin(a), 0, np.cos(a)]])
    about_x = np.array([[1, 0, 0], [0, np.cos(e), np.sin(e)], [0, -np.sin(e), np.cos(e)]])
    about_z = np.array([[np.cos(r), -np.sin(r), 0], [np.sin(r), np.cos(r), 0], [0, 0, 1]])
    rotation: NDArray[np.float64] = about_y @ about_x @ about_z
    return rotation


def _coefficient_rotation(rotation: NDArray[np.float64], order: int) -> NDArray[np.float64]:
    """The matrix of a rotation on coefficients, ((order + 1)^2, (order + 1)^2).

    A rotated harmonic of order l is a sum of harmonics of order l. So least squares at more points than coefficients
    is exact. The usual recurrences are faster, which a 16 x 16 matrix does not need.
    """
    points = sphere_points(64)
    matrix: NDArray[np.float64] = np.linalg.lstsq(basis(points, order), basis(points @ rotation, order), rcond=None)[0]
    return matrix
