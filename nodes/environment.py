"""Environment maps: the light from every direction, as an equirectangular panorama.

Rows run from straight up to straight down, columns once around. The middle column looks towards the viewer (+z), which
is in front of the person in the photo. The panorama is seen from inside, so the picture's right (+x) is on its left
half: the column at 1/4 of the width looks to +x, the column at 3/4 to -x.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.harmonics import basis
from graphface.nodes.types import Environment, Lighting

LAMBERT = np.repeat([1.0, 2 / 3, 1 / 4, 0.0], [1, 3, 5, 7])
"""A_l / pi of each coefficient: how much a Lambertian surface attenuates each order of the light (Ramamoorthi and
Hanrahan 2001, equations 8 and 9). Divided by pi, so that radiance 1 from everywhere is shading 1. Order 3 is 0: it does
not change the irradiance of a Lambertian surface."""


def directions(height: int, width: int) -> NDArray[np.float64]:
    """Unit vectors in the camera frame that the pixels of a panorama look to: (height, width, 3).

    >>> directions(1, 4)[0].round(3) + 0  # pixel centres at 1/8, 3/8, 5/8 and 7/8 of the turn
    array([[ 0.707,  0.   , -0.707],
           [ 0.707,  0.   ,  0.707],
           [-0.707,  0.   ,  0.707],
           [-0.707,  0.   , -0.707]])
    """
    polar = (np.arange(height) + 0.5) / height * np.pi
    azimuth = ((np.arange(width) + 0.5) / width - 0.5) * 2 * np.pi
    radius = np.sin(polar)[:, None]
    y = np.broadcast_to(np.cos(polar)[:, None], (height, width))
    return np.stack([-radius * np.sin(azimuth), y, radius * np.cos(azimuth)], axis=2)


def solid_angles(height: int, width: int) -> NDArray[np.float64]:
    """Steradians of each pixel of a panorama: (height, width); their sum is 4 pi.

    >>> round(float(solid_angles(32, 64).sum() / np.pi), 6)
    4.0
    """
    edges = np.cos(np.arange(height + 1) / height * np.pi)
    return np.repeat(((edges[:-1] - edges[1:]) * 2 * np.pi / width)[:, None], width, axis=1)


def environment_light(environment: Environment, order: int = 2) -> Lighting:
    """The irradiance of a panorama as a light; see `sh.from_environment`.

    Args:
        environment: radiance float32 H x W x 3, linear.
        order: 0 to 3.

    Returns:
        Coefficients float32 ((order + 1)^2, 3), linear.

    >>> light = environment_light(Environment(np.ones((32, 64, 3), np.float32)), order=1)
    >>> (light.coefficients[:, 0] * 0.282095).round(3) + 0  # radiance 1 from everywhere is irradiance 1
    array([1., 0., 0., 0.], dtype=float32)
    """
    height, width = environment.radiance.shape[:2]
    values = environment.radiance.reshape(-1, 3)
    weights = solid_angles(height, width).reshape(-1, 1)
    harmonics = basis(directions(height, width).reshape(-1, 3), order)
    coefficients = LAMBERT[: (order + 1) ** 2, None] * (harmonics.T @ (values * weights))
    return Lighting(coefficients.astype(np.float32))
