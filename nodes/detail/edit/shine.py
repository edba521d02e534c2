"""Shine: the broad bright patches of the detail map, which Lambertian shading cannot make."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node
from graphface.nodes.color import channel_mean
from graphface.nodes.detail.edit.bands import edited_map, gaussian
from graphface.nodes.types import DetailMap, FloatArray, Landmarks, Mask

SIZE = 0.3
"""Inter-ocular distances: highlights are patches smaller than this, brighter than what is around them."""


KNEE = 0.04
"""Of the map's unit: what exceeds its surroundings by less is skin tone, not a highlight."""


@node("detail.edit.shine")
def shine(
    detail: DetailMap,
    landmarks: Landmarks,
    where: Mask | None = None,
    *,
    strength: Annotated[float, Field(ge=0, le=4)] = 0.3,
) -> DetailMap:
    """Scale what is brighter than its surroundings: 0 makes the skin matt, 2 makes it oily.

    After the "shine" control of Boyadzhiev et al. 2015: positive, low and middle frequencies of the luminance. The
    change is grey, as the highlight of a dielectric is. Give the face as `where`: a white collar is no highlight.
    """
    unit = max(landmarks.interocular, 1e-3)

    def edit(values: FloatArray) -> FloatArray:
        grey = channel_mean(values)
        excess = gaussian(grey, 0.02 * unit) - gaussian(grey, SIZE * unit)
        edited = values + np.float32(strength - 1) * np.maximum(excess - np.float32(KNEE), 0)[..., None]
        return np.asarray(edited, np.float32)

    return detail if strength == 1 else edited_map(detail, edit, where)
