"""Environment maps: the light that comes from every direction, as an equirectangular panorama.

Rows run from straight up to straight down, columns once around. The middle column looks towards the viewer (+z), that
is, at what the person in the photo has before the eyes. As in every panorama seen from inside, the picture's right (+x)
is then on the left half: column 1/4 looks to +x, column 3/4 to -x.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.harmonics import basis
from graphface.nodes.types import Environment, Lighting


def directions(height: int, width: int) -> NDArray[np.float64]:
    """Unit vectors (height, width, 3) that the pixels of a panorama look to, in the camera frame."""
    polar = (np.arange(height) + 0.5) / height * np.pi
    turn = ((np.arange(width) + 0.5) / width - 0.5) * 2 * np.pi
    ring = np.sin(polar)[:, None]
    y = np.broadcast_to(np.cos(polar)[:, None], (height, width))
    return np.stack([-ring * np.sin(turn), y, ring * np.cos(turn)], axis=2)


def solid_angles(height: int, width: int) -> NDArray[np.float64]:
    """Steradians of each pixel, (height, width); they sum to 4 pi exactly."""
    edges = np.cos(np.arange(height + 1) / height * np.pi)
    return np.repeat(((edges[:-1] - edges[1:]) * 2 * np.pi / width)[:, None], width, axis=1)


LAMBERT = np.repeat([1.0, 2 / 3, 1 / 4, 0.0], [1, 3, 5, 7])
"""A_l / pi, by which a Lambertian surface dims each order of the light (Ramamoorthi and Hanrahan 2001, equation 8).
Over pi, so that radiance 1 from everywhere is shading 1. Order 3 does not reach a Lambertian surface at all."""


def environment_light(environment: Environment, order: int = 2) -> Lighting:
    """The irradiance of a panorama as a light, coefficients (n, 3), linear; see `sh.from_environment`."""
    height, width = environment.radiance.shape[:2]
    values = environment.radiance.reshape(-1, 3)
    weights = solid_angles(height, width).reshape(-1, 1)
    harmonics = basis(directions(height, width).reshape(-1, 3), order)
    coefficients = LAMBERT[: (order + 1) ** 2, None] * (harmonics.T @ (values * weights))
    return Lighting(coefficients.astype(np.float32))
