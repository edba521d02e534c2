"""How much of added light each pixel reflects."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node, warn
from graphface.nodes.color import channel_mean
from graphface.nodes.render.dark_texture import rough_below
from graphface.nodes.types import FloatArray, Image, Landmarks, Mask, Segmentation, Shading

_BLACK, _MUCH = 0.5, 0.1
"""Response that is told of, and the share of the skin from which it is."""


@node("render.response")
def response(
    own: Shading,
    estimated: Shading,
    labels: Segmentation,
    photo: Image | None = None,
    landmarks: Landmarks | None = None,
    *,
    floor: Annotated[float, Field(gt=0, le=1)] = 0.02,
    rougher: Annotated[float, Field(ge=1, le=100)] = 3.0,
) -> Mask:
    """The share of added light that a pixel reflects: 1 on skin, less on dark hair, dark clothes and nearly black skin.

    Shading is intensity, so the darkness of brown hair or of a navy suit is in `own`, and the albedo has only its
    color. If light were added there as on skin, the pixel would glow in that color. So beside the skin added light
    counts in proportion to own / estimated, as it does in the shading ratio.

    What a camera recorded of nearly black skin is noise and the blocks of its JPEG file (see `dark_texture`). Added
    light would show them, so it counts less there.

    Args:
        own: the photo's shading by the intrinsic method, H x W.
        estimated: shading under the photo's estimated light, H x W or H x W x 3.
        photo, landmarks: without them all skin reflects in full.
        floor: least estimated shading that is divided by.
        rougher: skin counts as noisy below the brightness, at most 0.15, where its texture is so many times that of
            lit skin, each relative to its brightness. There added light counts in proportion to the brightness. With 2
            the clean shadows of path-traced heads lose light as well; photographs look the same.

    Returns:
        H x W in [0, 1]: on skin 1, or less where it is dark and rough; elsewhere own / estimated, at most 1. If a tenth
        of the skin gets less than half of the light, there is a warning.
    """
    on_skin: FloatArray | np.float32 = np.float32(1)
    if photo is not None and landmarks is not None:
        brightness = channel_mean(photo.pixels)
        darkest = rough_below(brightness, labels.face, landmarks, rougher)
        if darkest > 0:
            on_skin = of_dark_skin(brightness, darkest)
            _tell_of_black(on_skin, labels.face)
    return reflected_share(own, estimated, labels.face, on_skin, floor)


def reflected_share(
    own: Shading, estimated: Shading, face: Mask, on_skin: FloatArray | np.float32, floor: float
) -> FloatArray:
    """own / estimated beside the face, at most 1, and `on_skin` on it: H x W."""
    ratio = np.clip(own / np.maximum(channel_mean(estimated), np.float32(floor)), 0, 1)
    return np.asarray(ratio + (on_skin - ratio) * face, np.float32)


def of_dark_skin(brightness: FloatArray, darkest: float) -> FloatArray:
    """The share of added light that skin takes which is noisy below the brightness `darkest`, above 0."""
    return np.asarray(np.clip(brightness / np.float32(darkest), 0, 1), np.float32)


def _tell_of_black(response: FloatArray, face: Mask) -> None:
    skin = float(face.sum(dtype=np.float64))
    black = float((face * (response <= _BLACK)).sum(dtype=np.float64)) / max(skin, 1.0)
    if black > _MUCH:
        warn(
            f"render.response: {100 * black:.0f} % of the skin is dark and noisy; it takes at most half of the light"
            " that is added, or noise and JPEG blocks would show"
        )
