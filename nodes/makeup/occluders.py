"""Occluders and openings: rims of glasses, lashes, nostrils. Makeup is not transferred onto them."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import Formerly, node
from graphface.nodes.color import channel_mean
from graphface.nodes.face_scale import face_scale
from graphface.nodes.types import Features, FloatArray, Landmarks, Mask, Shading

_FLOOR = np.float32(0.02)
"""Added to both intensities before they are divided."""


@node("makeup.occluders", formerly=("makeup.in_front",))
def occluders(
    shading: Shading,
    features: Features,
    landmarks: Landmarks,
    *,
    dark: Annotated[float, Field(gt=0, le=1)] = 0.55,
    neighborhood: Annotated[float, Field(gt=0, le=1), Formerly("size")] = 0.12,
    resolution: Annotated[int, Field(ge=8, le=256)] = 64,
) -> Mask:
    """Small things much darker than the face around them, H x W, 0 to 1; brows, lips and openings are left out.

    What is dark and broad may be a shadow or a beard, and is left to other masks.

    Args:
        shading: the photo's intensity.
        dark: ratio of intensity to its local mean below which a pixel begins to count; below 2/3 of it, it counts
            fully.
        neighborhood: sigma of the Gaussian of the local mean, in inter-ocular distances.
        resolution: pixels per inter-ocular distance of the copy on which the local mean is computed.
    """
    import cv2

    intensity = channel_mean(shading)
    copy = face_scale(landmarks, intensity.shape, resolution)
    sigma = max(neighborhood * copy.interocular, 0.5)
    local_mean = copy.up(np.asarray(cv2.GaussianBlur(copy.down(intensity), (0, 0), sigma), np.float32))
    ratio = (intensity + _FLOOR) / (local_mean + _FLOOR)
    found: FloatArray = np.clip(3 - ratio * np.float32(3 / dark), 0, 1)
    found *= 1 - np.minimum(features.any_of("brows", "lips", "eyes", "mouth"), 1)
    return np.asarray(found, np.float32)
