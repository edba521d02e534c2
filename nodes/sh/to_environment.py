"""Spherical harmonics as a panorama."""

from __future__ import annotations

from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from graphface import node, warn
from graphface.nodes.environment import LAMBERT, directions
from graphface.nodes.harmonics import basis
from graphface.nodes.types import Environment, Lighting


@node("sh.to_environment")
def to_environment(
    light: Lighting,
    *,
    height: Annotated[int, Field(ge=2, le=4096)] = 64,
    quantity: Literal["irradiance", "radiance"] = "irradiance",
) -> Environment:
    """A light as a panorama, H x 2H.

    Args:
        quantity: "irradiance" is that of a surface facing each direction. "radiance" divides by the attenuation A_l of
            a Lambertian surface, which gives the smoothest panorama with this irradiance; order 3 is left out, because
            it has no irradiance. Negative values, which a truncated series has, become 0.
    """
    coefficients = light.coefficients.reshape(len(light.coefficients), -1).astype(np.float64)
    if quantity == "radiance":
        if light.order > 2:
            warn("sh.to_environment: order 3 does not reach a Lambertian surface; the panorama has the lower orders")
            coefficients = coefficients[:9]
        coefficients = coefficients / LAMBERT[: len(coefficients), None]
    order = round(float(np.sqrt(len(coefficients)))) - 1
    values = basis(directions(height, 2 * height).reshape(-1, 3), order) @ coefficients
    radiance = np.maximum(values, 0).astype(np.float32).reshape(height, 2 * height, -1)
    return Environment(np.ascontiguousarray(np.broadcast_to(radiance, (height, 2 * height, 3))))
