"""Specular highlights of hair."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node
from graphface.nodes.color import channel_mean
from graphface.nodes.smoothstep import smoothstep
from graphface.nodes.types import Image, Mask, Segmentation

Percentile = Annotated[float, Field(ge=0, le=100)]


_LEAST_CONTRAST = 0.02
"""Least difference of intensity between dull and bright hair."""


@node("render.hair_shine")
def hair_shine(
    photo: Image, labels: Segmentation, mask: Mask, *, dull: Percentile = 50.0, bright: Percentile = 97.0
) -> Mask:
    """Bright pixels of hair, which are likely to be specular highlights (paper, section 4.1): 0 elsewhere.

    Args:
        mask: the face by its geometry, H x W. Where it is 1 the result is 0, because a bright pixel there is more
            likely skin that was labelled hair, and a patch of the old light would show on it.
        dull, bright: percentiles of the hair's intensity between which the result rises from 0 to the share of hair.
    """
    intensity = channel_mean(photo.pixels)
    in_hair = intensity[labels.hair > 0.5]
    if in_hair.size < 2:
        return np.zeros_like(intensity)
    low, high = np.percentile(in_hair[:: max(1, in_hair.size // 20_000)], (dull, max(bright, dull)))
    t = (intensity - np.float32(low)) / np.float32(max(high - low, _LEAST_CONTRAST))
    return np.asarray(smoothstep(t) * labels.hair * (1 - mask), np.float32)
