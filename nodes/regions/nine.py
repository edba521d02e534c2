"""The nine regions of detail transfer."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from graphface import node
from graphface.nodes.regions.atlas import atlas, projected
from graphface.nodes.types import REGIONS, Image, Landmarks, Regions


@node("regions.nine")
def nine(
    photo: Image,
    landmarks: Landmarks,
    *,
    softness: Annotated[float, Field(ge=0.01, le=0.5)] = 0.08,
    partition: bool = True,
) -> Regions:
    """The nine regions of one face (paper, "Face Detail Transfer"), H x W each.

    Args:
        photo: gives the size; its pixels are not read. landmarks: scheme "facemesh468".
        softness: width of the ramp from 1 to 0, half of it inside of the contour, in inter-ocular distances.
        partition: temples, chin and what else lies between the contours belong to the nearest region, and the nine sum
            to 1 over the face. False leaves them out.

    Raises:
        UsageError: the landmarks follow another scheme.
    """
    drawn = atlas(softness, partition)
    return Regions(*projected([drawn[name] for name in REGIONS], photo, landmarks))
