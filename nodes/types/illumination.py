"""Illumination: spherical harmonics and panoramas."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from graphface.nodes.types.agreement import mismatch
from graphface.nodes.types.arrays import Direction, FloatArray, Shading


@dataclass(frozen=True)
class Lighting:
    """Spherical-harmonic light; shading is sum_i coefficients[i] * Y_i(normal), see `graphface.nodes.harmonics`.

    Attributes:
        coefficients: float32 (n,), or (n, 3) with one light per channel; n = 1, 4, 9 or 16, in (l, m) order.
    """

    coefficients: FloatArray

    def flaw(self) -> str | None:
        """Why its parts do not belong together."""
        if self.coefficients.ndim not in (1, 2) or self.coefficients.shape[0] not in (1, 4, 9, 16):
            return f"coefficients have the shape {self.coefficients.shape}, expected (n) or (n, 3), n = 1, 4, 9 or 16"
        return mismatch(self, {"coefficients": "N 3"}) if self.coefficients.ndim == 2 else None

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

    def flaw(self) -> str | None:
        """Why its parts do not belong together."""
        if self.radiance.size and self.radiance.min() < 0:
            return "radiance is below 0"
        return mismatch(self, {"radiance": "H W 3"}) or (None if self.radiance.size else "radiance has no pixels")
