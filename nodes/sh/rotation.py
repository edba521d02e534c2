"""Turning a light around the face."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from graphface import node
from graphface.nodes.sh.harmonics import basis, sphere_points
from graphface.nodes.types import Lighting

Angle = Annotated[float, Field(ge=-360, le=360)]


@node("sh.rotate")
def rotate(light: Lighting, *, azimuth: Angle = 0.0, elevation: Angle = 0.0, roll: Angle = 0.0) -> Lighting:
    """The same light from elsewhere: what came from the viewer comes from (azimuth, elevation) afterwards.

    Args:
        azimuth: degrees, positive to the picture's right. elevation: degrees, positive upwards, before the azimuth.
        roll: degrees about the viewing axis, positive counter-clockwise in the picture, before both.
    """
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
