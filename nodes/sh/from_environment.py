"""A panorama projected to spherical harmonics."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from graphface import node
from graphface.nodes.environment import environment_light
from graphface.nodes.types import Environment, Lighting


@node("sh.from_environment")
def from_environment(environment: Environment, *, order: Annotated[int, Field(ge=0, le=3)] = 2) -> Lighting:
    """The irradiance of a panorama as a light.

    c_lm = (A_l / pi) * integral of L(w) Y_lm(w) dw (Ramamoorthi and Hanrahan 2001, with A_l of their equation 8), as a
    sum over pixels times their solid angles.

    Args:
        environment: L, radiance, linear.
        order: 2 has all but a percent of any irradiance.

    Returns:
        Coefficients ((order + 1)^2, 3), linear; radiance 1 from everywhere is irradiance 1.
    """
    return environment_light(environment, order)
