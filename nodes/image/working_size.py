"""A photo at the size at which a face is worked on."""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node
from graphface.nodes.face_scale import face_scale
from graphface.nodes.types import Image, Landmarks

_MOST_KEPT = 0.25
"""Share of the pixels above which the photo is left as it is: to make a picture of its size costs what is saved."""


@node("image.working_size")
def working_size(
    photo: Image,
    landmarks: Landmarks,
    *,
    resolution: Annotated[float, Field(ge=16, le=4096)] | None = None,
    megapixels: Annotated[float, Field(gt=0, le=1000)] = 4.0,
) -> Image:
    """The photo, reduced to `resolution` pixels between the outer corners of the eyes.

    Geometry, labels, light and shading are smooth. Above some resolution they cost more and get no better, and
    `render.full_size` makes of them a picture of the photo's own size.

    Args:
        photo: any encoding; areas are averaged in it, and transparency is left out.
        landmarks: on the photo.
        resolution: None keeps every pixel. A photo that would keep more than a quarter of its pixels keeps all.
        megapixels: bound of the result's size, for a small face in a large photo.

    Returns:
        The same object where nothing is reduced.
    """
    if resolution is None:
        return photo
    most = max(photo.height, photo.width) * min(1.0, (megapixels * 1e6 / (photo.height * photo.width)) ** 0.5)
    copy = face_scale(landmarks, photo.pixels.shape, resolution, most=max(1, round(most)))
    if copy.scale**2 > _MOST_KEPT:
        return photo
    return replace(photo, pixels=np.ascontiguousarray(copy.down(photo.pixels)), alpha=None)
