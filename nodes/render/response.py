"""How much each pixel answers to added light."""

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
    """How much a pixel answers to added light: all of it on skin, less where it is dark by itself.

    Beside the skin a pixel darker than the estimated light says is dark by itself (brown hair, a navy suit): intensity
    as shading has put its darkness into `own`, and all its color into the albedo. Light added as on skin would make it
    glow in that color, so there added light counts in proportion to `own` over `estimated`: as in the ratio.

    Args:
        own: the photo's own shading, H x W.
        estimated: shading under the photo's estimated light, H x W or H x W x 3.

    Returns:
        1 where the label is face; elsewhere own / estimated, at most 1.
    """
    share = np.clip(own / np.maximum(channel_mean(estimated), np.float32(floor)), 0, 1)
    return np.asarray(1 + (share - 1) * (1 - labels.face), np.float32)
