"""Where the reference is painted."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node
from graphface.nodes.color import channel_mean, in_three_channels
from graphface.nodes.face_scale import face_scale
from graphface.nodes.types import Image, Landmarks, Mask

Scale = Annotated[float, Field(gt=0, le=2)]


_LEAST_COLOR = np.float32(0.05)


_DARK = np.float32(0.03)
"""Added to color and intensity: what is nearly black is grey."""


@node("transfer.paint")
def paint(
    photo: Image,
    reference: Image,
    mask: Mask,
    landmarks: Landmarks,
    *,
    faint: Annotated[float, Field(ge=0, le=2)] = 0.12,
    full: Annotated[float, Field(gt=0, le=2)] = 0.3,
    margin: Scale = 0.03,
    resolution: Annotated[int, Field(ge=8, le=256)] = 80,
) -> Mask:
    """Where the reference is another color than the same place of the photo, each measured by its own skin.

    Lipstick darkens what it lies on, and so does a drawn moon: that is no relief, and colors stay the photo's.

    Args:
        photo, reference: the photo, and the reference warped to it. Color is that over intensity, as photographed: an
            albedo may have been given the skin's color where it is dark.
        mask: the faces' common part, over which the color of the skin is the median.
        faint, full: difference of color, the skin's being 1, at which paint begins and is certain.
        margin: width added around what is found, in inter-ocular distances: paint has edges.
        resolution: pixels per inter-ocular distance of the copy on which it is decided.
    """
    import cv2

    copy = face_scale(landmarks, mask.shape, resolution)
    unit = copy.interocular
    where = copy.down(mask) > 0.5
    if not where.any():
        return np.zeros_like(mask)
    colors = []
    for pixels in (copy.down(photo.pixels), copy.down(reference.pixels)):
        color = (pixels + _DARK) / in_three_channels(np.maximum(channel_mean(pixels), 0) + _DARK)
        colors.append(color / np.maximum(np.median(color[where], axis=0), _LEAST_COLOR))
    apart = np.abs(colors[0] - colors[1]).max(axis=2).astype(np.float32)
    apart = cv2.GaussianBlur(apart, (0, 0), max(0.02 * unit, 0.5))
    apart = cv2.dilate(apart, cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (2 * round(margin * unit) + 1,) * 2))
    found = np.clip((apart - faint) / max(full - faint, 1e-3), 0, 1).astype(np.float32)
    return np.asarray(np.clip(copy.up(found), 0, 1) * (mask > 0), np.float32)
