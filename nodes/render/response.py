"""How much of added light each pixel reflects."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node
from graphface.nodes.color import channel_mean
from graphface.nodes.types import Mask, Segmentation, Shading


@node("render.response")
def response(
    own: Shading, estimated: Shading, labels: Segmentation, *, floor: Annotated[float, Field(gt=0, le=1)] = 0.02
) -> Mask:
    """The share of added light that a pixel reflects: 1 on skin, less on dark hair and dark clothes.

    Shading is intensity, so the darkness of brown hair or of a navy suit is in `own`, and the albedo has only its
    color. If light were added there as on skin, the pixel would glow in that color. So beside the skin added light
    counts in proportion to own / estimated, as it does in the shading ratio.

    Args:
        own: the photo's shading by the intrinsic method, H x W.
        estimated: shading under the photo's estimated light, H x W or H x W x 3.
        floor: least estimated shading that is divided by.

    Returns:
        H x W in [0, 1]: 1 where the label is face; elsewhere own / estimated, at most 1.
    """
    ratio = np.clip(own / np.maximum(channel_mean(estimated), np.float32(floor)), 0, 1)
    return np.asarray(1 + (ratio - 1) * (1 - labels.face), np.float32)
