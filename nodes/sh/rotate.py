"""Turning a light around the face."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from graphface import node
from graphface.nodes.harmonics import rotated
from graphface.nodes.types import Lighting

Angle = Annotated[float, Field(ge=-360, le=360)]


@node("sh.rotate")
def rotate(light: Lighting, *, azimuth: Angle = 0.0, elevation: Angle = 0.0, roll: Angle = 0.0) -> Lighting:
    """The same light from elsewhere: what came from the viewer comes from (azimuth, elevation) afterwards.

    Args:
        azimuth: degrees, positive to the picture's right. elevation: degrees, positive upwards, before the azimuth.
        roll: degrees about the viewing axis, positive counter-clockwise in the picture, before both.
    """
    return rotated(light, azimuth, elevation, roll)
