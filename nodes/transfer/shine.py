"""The reference's shine, or its lack of shine."""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node
from graphface.nodes.blur import blurred
from graphface.nodes.bounding_box import bounding_box
from graphface.nodes.color import channel_mean
from graphface.nodes.face_scale import FaceScale, face_scale
from graphface.nodes.relief import FLOOR, filled
from graphface.nodes.types import DetailMap, FloatArray, Image, Landmarks, Mask

Strength = Annotated[float, Field(ge=0, le=2)]

_SMALLEST, _LARGEST = 0.015, 0.3
"""Sigmas, in inter-ocular distances, between which a patch of shine lies."""

_EVEN = np.float32(0.05)
"""Excess over the skin around, as a share of it, that is skin and not shine."""


@node("transfer.shine")
def shine(
    detail: DetailMap,
    photo: Image,
    mask: Mask,
    skin: Mask,
    landmarks: Landmarks,
    reference: Image | None = None,
    *,
    more: Strength = 0.0,
    less: Annotated[float, Field(ge=0, le=1)] = 0.0,
    resolution: Annotated[int, Field(ge=8, le=256)] = 60,
) -> DetailMap:
    """Shine that the reference has and the photo lacks is added, and what the reference lacks is taken off.

    Shine is what is brighter than the skin around by more than skin varies. It is added as grey light, in proportion to
    the photo's own brightness, and taken off in every channel, so that the color of skin is left.

    Args:
        detail: the photo's, additive.
        mask: how much is changed. skin: where both photos show skin.
        reference: warped to the photo; without one its skin is perfectly matte.
        more, less: strength of what is added and of what is taken off. With 0 and 0 the map is returned as it is.
        resolution: pixels per inter-ocular distance of the copy on which shine is found.
    """
    box = bounding_box(mask)
    if box is None or (more == 0 and less == 0):
        return detail
    copy = face_scale(landmarks, mask[box].shape, resolution)
    weight = copy.down(skin[box])
    pixels = copy.down(photo.pixels[box])
    own, own_level = _shine(pixels, weight, copy)
    other = np.zeros((*copy.size, 1), np.float32)
    if reference is not None:
        other, level = _shine(channel_mean(copy.down(reference.pixels[box]))[..., None], weight, copy)
        other *= channel_mean(own_level)[..., None] / (level + FLOOR)
    own_light = channel_mean(own)[..., None]
    change = np.float32(more) * np.maximum(other - own_light, 0)
    change = change - np.float32(less) * own * np.clip(1 - other / np.maximum(own_light, 1e-4), 0, 1)
    offset = detail.offset.copy()
    offset[box] += copy.up(np.asarray(change, np.float32)) * mask[box][..., None]
    return replace(detail, offset=offset)


def _shine(pixels: FloatArray, skin: Mask, copy: FaceScale) -> tuple[FloatArray, FloatArray]:
    """The shine of a small picture H x W x c, and the level of the skin that it lies on."""
    spread = filled(pixels, skin, copy.interocular)
    smooth, level = (blurred(spread, max(width * copy.interocular, 0.5)) for width in (_SMALLEST, _LARGEST))
    smooth, level = (values.reshape(pixels.shape) for values in (smooth, level))
    found = np.maximum(smooth - (1 + _EVEN) * level, 0) * skin[..., None]
    return np.asarray(found, np.float32), level
