"""Panoramas to spherical harmonics and back."""

from __future__ import annotations

from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from graphface import node, warn
from graphface.nodes.envmap import Environment, directions, solid_angles
from graphface.nodes.sh.harmonics import basis
from graphface.nodes.types import FloatArray, Lighting

LAMBERT = np.repeat([1.0, 2 / 3, 1 / 4, 0.0], [1, 3, 5, 7])
"""A_l / pi, by which a Lambertian surface dims each order of the light (Ramamoorthi and Hanrahan 2001, equation 8).
Over pi, so that radiance 1 from everywhere is shading 1. Order 3 does not reach a Lambertian surface at all."""


@node("sh.from_environment")
def from_environment(environment: Environment, *, order: Annotated[int, Field(ge=0, le=3)] = 2) -> Lighting:
    """The irradiance of a panorama as a light.

    c_lm = (A_l / pi) * integral of L(w) Y_lm(w), by summation over pixels with their solid angles.

    Args:
        environment: radiance, linear.
        order: 2 holds all but a percent of any light.

    Returns:
        (n, 3) coefficients, linear.
    """
    height, width = environment.radiance.shape[:2]
    values = environment.radiance.reshape(-1, 3)
    weights = solid_angles(height, width).reshape(-1, 1)
    harmonics = basis(directions(height, width).reshape(-1, 3), order)
    coefficients = LAMBERT[: (order + 1) ** 2, None] * (harmonics.T @ (values * weights))
    return Lighting(coefficients.astype(np.float32))


@node("sh.to_environment")
def to_environment(
    light: Lighting,
    *,
    height: Annotated[int, Field(ge=2, le=4096)] = 64,
    quantity: Literal["irradiance", "radiance"] = "irradiance",
) -> Environment:
    """A light as a panorama, H x 2H.

    Args:
        quantity: "irradiance" shows what each direction's surface would receive; "radiance" undoes Lambert's dimming
            and gives the smoothest panorama behind the light (order 3 is left out: no surface shows it). Negative
            values, which such few orders bring along, become 0.
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
    return Environment(_three_channels(radiance))


def _three_channels(values: FloatArray) -> FloatArray:
    return np.ascontiguousarray(np.broadcast_to(values, (*values.shape[:2], 3)))
