"""What lies in front of the skin, or is open: rims of glasses, lashes, nostrils. Paint has no business there."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node
from graphface.nodes.color import channel_mean
from graphface.nodes.face_scale import face_scale
from graphface.nodes.types import Features, FloatArray, Landmarks, Mask, Shading

_LEAST_LIGHT = 0.02


@node("makeup.in_front")
def in_front(
    shading: Shading,
    features: Features,
    landmarks: Landmarks,
    *,
    dark: Annotated[float, Field(gt=0, le=1)] = 0.55,
    size: Annotated[float, Field(gt=0, le=1)] = 0.12,
    resolution: Annotated[int, Field(ge=8, le=256)] = 64,
) -> Mask:
    """Small things much darker than the face around them, off brows, lips and the openings.

    What is dark and broad may be a shadow or a beard, and is left to the masks.

    Args:
        shading: the input's intensity.
        dark: brightness over that of the surroundings at which a pixel begins to count; at two thirds of it, it does.
        size: of the surroundings, in inter-ocular distances.
        resolution: pixels per inter-ocular distance of the copy on which surroundings are averaged.
    """
    import cv2

    grey = channel_mean(shading)
    copy = face_scale(landmarks, grey.shape, resolution)
    sigma = max(size * copy.interocular, 0.5)
    around = copy.up(np.asarray(cv2.GaussianBlur(copy.down(grey), (0, 0), sigma), np.float32))
    relative = (grey + np.float32(_LEAST_LIGHT)) / (around + np.float32(_LEAST_LIGHT))
    found: FloatArray = np.clip(3 - relative * np.float32(3 / dark), 0, 1)
    found *= 1 - np.minimum(features.any_of("brows", "lips", "eyes", "mouth"), 1)
    return np.asarray(found, np.float32)
