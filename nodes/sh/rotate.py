"""A light rotated around the face."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from graphface import node
from graphface.nodes.harmonics import rotated
from graphface.nodes.types import Lighting

Angle = Annotated[float, Field(ge=-360, le=360)]


@node("sh.rotate")
def rotate(light: Lighting, *, azimuth: Angle = 0.0, elevation: Angle = 0.0, roll: Angle = 0.0) -> Lighting:
    """The light rotated by `roll`, then by `elevation`, then by `azimuth`.

    Light from the viewer's direction then comes from (azimuth, elevation).

    Args:
        azimuth: degrees, positive to the picture's right.
        elevation: degrees, positive upwards.
        roll: degrees about the viewing axis, positive counter-clockwise in the picture.
    """
    return rotated(light, azimuth, elevation, roll)
