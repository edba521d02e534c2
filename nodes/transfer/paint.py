"""Where the reference is painted."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node
from graphface.nodes.color import channel_mean, in_three_channels
from graphface.nodes.types import (
    FloatArray,
    Image,
    Landmarks,
    Mask,
)

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

    unit = max(landmarks.interocular, 1e-3)
    scale = min(1.0, resolution / unit)
    size = [max(1, round(n * scale)) for n in mask.shape[::-1]]
    unit *= scale

    def small(values: FloatArray) -> FloatArray:
        return np.asarray(cv2.resize(values, size, interpolation=cv2.INTER_AREA), np.float32)

    where = small(mask) > 0.5
    if not where.any():
        return np.zeros_like(mask)
    colors = []
    for pixels in (small(photo.pixels), small(reference.pixels)):
        color = (pixels + _DARK) / in_three_channels(np.maximum(channel_mean(pixels), 0) + _DARK)
        colors.append(color / np.maximum(np.median(color[where], axis=0), _LEAST_COLOR))
    apart = np.abs(colors[0] - colors[1]).max(axis=2).astype(np.float32)
    apart = cv2.GaussianBlur(apart, (0, 0), max(0.02 * unit, 0.5))
    apart = cv2.dilate(apart, cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (2 * round(margin * unit) + 1,) * 2))
    found = np.clip((apart - faint) / max(full - faint, 1e-3), 0, 1).astype(np.float32)
    shown = cv2.resize(found, mask.shape[::-1], interpolation=cv2.INTER_LINEAR)
    return np.asarray(np.clip(shown, 0, 1) * (mask > 0), np.float32)
