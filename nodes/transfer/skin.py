"""Where both photos show bare skin."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from graphface import node
from graphface.nodes.blur import blurred, gaussian
from graphface.nodes.bounding_box import bounding_box
from graphface.nodes.color import channel_mean
from graphface.nodes.disc import disc
from graphface.nodes.face_scale import FaceScale, face_scale
from graphface.nodes.relief import filled, logarithm
from graphface.nodes.smoothstep import smoothstep
from graphface.nodes.types import Features, FloatArray, Image, Landmarks, Mask

Share = Annotated[float, Field(ge=0, le=1)]

_SURROUNDINGS = 0.25
"""Sigma, in inter-ocular distances, of the average that darkness is compared with."""

_RAMP = 0.3
"""From too dark to dark enough, of the logarithm of intensity."""


@node("transfer.skin")
def skin(
    core: Mask,
    photo: Image,
    reference: Image,
    features: Features,
    landmarks: Landmarks,
    *,
    brows: Share = 0.0,
    lips: Share = 0.0,
    darkest: Annotated[float, Field(gt=0, le=5)] = 0.6,
    margin: Annotated[float, Field(ge=0, le=0.5)] = 0.03,
    edge: Annotated[float, Field(ge=0, le=0.5)] = 0.08,
    resolution: Annotated[int, Field(ge=8, le=256)] = 100,
) -> Mask:
    """The core without eyes, mouth, brows, lips, and what is too dark for skin: strands, frames, nostrils, moles.

    Args:
        core: skin of both photos that corresponds (`makeup.core`). reference: warped to the photo.
        features, landmarks: the photo's.
        brows, lips: share of them that counts as skin. A brow or the line of the lips is identity, not detail.
        darkest: how far the logarithm of intensity may lie below that of the skin around; the deepest folds of 58
            portraits stay above it.
        margin: what is left out is dilated by this, in inter-ocular distances.
        resolution: pixels per inter-ocular distance of the copy on which it is found.
    """
    import cv2

    box = bounding_box(core)
    if box is None:
        return core
    copy = face_scale(landmarks, core[box].shape, resolution)
    around = disc(margin * copy.interocular)

    def without(part: FloatArray) -> FloatArray:
        return np.clip(1 - gaussian(np.asarray(cv2.dilate(part, around)), 0.01 * copy.interocular), 0, 1)

    shares = {"eyes": 0.0, "mouth": 0.0, "brows": brows, "lips": lips}
    bare = copy.down(core[box])
    bare *= smoothstep(_depth(bare > 0.5) / np.float32(max(edge * copy.interocular, 0.5)))
    for part, share in shares.items():
        bare *= without(np.float32(1 - share) * np.minimum(1.5 * copy.down(getattr(features, part)[box]), 1))
    for image in (photo, reference):
        bare *= without(_dark(copy.down(image.pixels[box]), bare, copy, darkest))
    found = np.zeros_like(core)
    found[box] = np.minimum(copy.up(bare), core[box])
    return found


def _depth(inside: NDArray[np.bool_]) -> FloatArray:
    """Distance of each pixel to what is not inside, the picture's border among it."""
    import cv2

    padded = np.pad(inside.astype(np.uint8), 1)
    return np.asarray(cv2.distanceTransform(padded, cv2.DIST_L2, 5)[1:-1, 1:-1], np.float32)


def _dark(pixels: FloatArray, bare: Mask, copy: FaceScale, darkest: float) -> FloatArray:
    """1 where the small picture is darker than the skin around by more than `darkest`, H x W."""
    light = gaussian(logarithm(channel_mean(pixels)), 0.015 * copy.interocular)
    level = filled(light[..., None], bare, copy.interocular)[..., 0]
    depth = blurred(level, max(_SURROUNDINGS * copy.interocular, 0.5)) - light
    return smoothstep(np.asarray((depth - np.float32(darkest)) / np.float32(_RAMP), np.float32))
