"""Where hair shines."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node
from graphface.nodes.color import channel_mean
from graphface.nodes.types import Image, Mask, Segmentation

Percent = Annotated[float, Field(ge=0, le=100)]


@node("render.hair_shine")
def hair_shine(photo: Image, labels: Segmentation, mask: Mask, *, dull: Percent = 50.0, bright: Percent = 97.0) -> Mask:
    """Where hair is bright, which is where it shines: 0 elsewhere, up to the share of hair at its brightest pixels.

    Args:
        mask: the face by its geometry. There a bright pixel is rather a forehead taken for hair, and a patch of old
            light amid the new would show: nothing shines where the mask is 1.
        dull, bright: percentiles of the hair's intensity between which the answer rises from 0 to 1.
    """
    grey = channel_mean(photo.pixels)
    of_hair = grey[labels.hair > 0.5]
    if of_hair.size < 2:
        return np.zeros_like(grey)
    low, high = np.percentile(of_hair[:: max(1, of_hair.size // 20_000)], (dull, max(bright, dull)))
    t = np.clip((grey - np.float32(low)) / np.float32(max(high - low, 0.02)), 0, 1)
    return np.asarray(t * t * (3 - 2 * t) * labels.hair * (1 - mask), np.float32)
