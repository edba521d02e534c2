"""A panorama to spherical harmonics."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from graphface import node
from graphface.nodes.environment import environment_light
from graphface.nodes.types import Environment, Lighting


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
    return environment_light(environment, order)
