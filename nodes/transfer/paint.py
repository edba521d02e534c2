"""Where the reference wears makeup."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from graphface import node
from graphface.nodes.color import channel_mean, in_three_channels
from graphface.nodes.disc import disc
from graphface.nodes.face_scale import face_scale
from graphface.nodes.types import FloatArray, Image, Landmarks, Mask

_LEAST_CHROMATICITY = np.float32(0.05)


_FLOOR = np.float32(0.03)
"""Added to color and intensity before they are divided: what is nearly black is grey."""


@node("transfer.paint")
def paint(
    photo: Image,
    reference: Image,
    mask: Mask,
    landmarks: Landmarks,
    *,
    faint: Annotated[float, Field(ge=0, le=2)] = 0.12,
    full: Annotated[float, Field(gt=0, le=2)] = 0.3,
    margin: Annotated[float, Field(gt=0, le=2)] = 0.03,
    resolution: Annotated[int, Field(ge=8, le=256)] = 80,
) -> Mask:
    """Where photo and reference differ in chromaticity, each relative to its own skin; H x W, 0 to 1.

    Lipstick, or a moon drawn on a cheek, darkens the skin it lies on. That is no relief, and detail transfer keeps the
    photo's colors.

    Args:
        photo, reference: the photo, and the reference warped to it. Chromaticity is color over intensity of the
            pixels, since an albedo may have been given the skin's color where it is dark.
        mask: the part that both faces show; the skin's chromaticity is the median over it.
        faint, full: difference, where the skin's chromaticity is 1, at which paint begins and is certain.
        margin: width of the dilation of what was found, in inter-ocular distances, since paint has edges.
        resolution: pixels per inter-ocular distance of the copy on which the two are compared.
    """
    import cv2

    copy = face_scale(landmarks, mask.shape, resolution)
    inside = copy.down(mask) > 0.5
    if not inside.any():
        return np.zeros_like(mask)
    of_photo, of_reference = (_relative_chromaticity(copy.down(image.pixels), inside) for image in (photo, reference))
    difference = np.abs(of_photo - of_reference).max(axis=2).astype(np.float32)
    difference = cv2.GaussianBlur(difference, (0, 0), max(0.02 * copy.interocular, 0.5))
    difference = cv2.dilate(difference, disc(margin * copy.interocular))
    found = np.clip((difference - faint) / max(full - faint, 1e-3), 0, 1).astype(np.float32)
    return np.asarray(np.clip(copy.up(found), 0, 1) * (mask > 0), np.float32)


def _relative_chromaticity(pixels: FloatArray, inside: NDArray[np.bool_]) -> FloatArray:
    """Color over intensity, divided by its median over the face: 1 for the color of the skin."""
    chromaticity = (pixels + _FLOOR) / in_three_channels(np.maximum(channel_mean(pixels), 0) + _FLOOR)
    of_skin = np.maximum(np.median(chromaticity[inside], axis=0), _LEAST_CHROMATICITY)
    return np.asarray(chromaticity / of_skin, np.float32)
