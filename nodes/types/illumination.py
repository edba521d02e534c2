"""Illumination: spherical harmonics and panoramas."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from graphface.nodes.types.arrays import Direction, FloatArray, Shading


@dataclass(frozen=True)
class Lighting:
    """Spherical-harmonic light; shading is sum_i coefficients[i] * Y_i(normal), see `graphface.nodes.harmonics`.

    Attributes:
        coefficients: float32 (n,), or (n, 3) with one light per channel; n = 1, 4, 9 or 16, in (l, m) order.
    """

    coefficients: FloatArray

    @property
    def order(self) -> int:
        return round(float(np.sqrt(self.coefficients.shape[0]))) - 1


@dataclass(frozen=True)
class LightingFit:
    """A fitted light.

    Attributes:
        light: in the encoding of the shading that it was fitted to.
        residual: float32 H x W (x 3), shading minus fit, signed; 0 off the mask.
        condition: condition number of the unregularized least squares, 1 to 1e12.
        direction: float32 (3,), unit vector towards most of the light; 0 for even light.
    """

    light: Lighting
    residual: Shading
    condition: float
    direction: Direction = field(default_factory=lambda: np.zeros(3, np.float32))


@dataclass(frozen=True)
class Environment:
    """Light from every direction as an equirectangular panorama, see `graphface.nodes.environment`.

    Attributes:
        radiance: float32 H x W x 3, linear, 0 or more; W is usually 2 H.
    """

    radiance: FloatArray
