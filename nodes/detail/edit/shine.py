"""Shine: broad bright patches of the detail map, which Lambertian shading cannot render."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node
from graphface.nodes.color import channel_mean
from graphface.nodes.detail.edit.frequencies import edited_map, gaussian
from graphface.nodes.types import DetailMap, FloatArray, Landmarks, Mask

SMALLEST, LARGEST = 0.02, 0.3
"""Size of highlights: standard deviations in inter-ocular distances of the blurs whose difference holds them."""


SKIN_VARIATION = 0.04
"""Excess over the surroundings, in the map's unit, that is skin tone and not a highlight."""


@node("detail.edit.shine")
def shine(
    detail: DetailMap,
    landmarks: Landmarks,
    where: Mask | None = None,
    *,
    strength: Annotated[float, Field(ge=0, le=4)] = 0.3,
) -> DetailMap:
    """Scale what is brighter than its surroundings: 0 makes the skin matt, 2 makes it oily.

    After the "shine" control of Boyadzhiev et al., TOG 2015: the positive low and middle frequencies of the luminance.
    The change is grey, like a highlight of a dielectric.

    Args:
        where: H x W in 0..1, the weight of the edit; the face mask, because a white collar is no highlight.
        strength: factor of the highlights.
    """
    interocular = max(landmarks.interocular, 1e-3)

    def edit(values: FloatArray) -> FloatArray:
        grey = channel_mean(values)
        excess = gaussian(grey, SMALLEST * interocular) - gaussian(grey, LARGEST * interocular)
        edited = values + np.float32(strength - 1) * np.maximum(excess - np.float32(SKIN_VARIATION), 0)[..., None]
        return np.asarray(edited, np.float32)

    return detail if strength == 1 else edited_map(detail, edit, where)
