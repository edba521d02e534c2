"""How much of the input's fine detail stays."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node
from graphface.nodes.types import Features, Mask

Share = Annotated[float, Field(ge=0, le=1)]


@node("makeup.keep")
def keep(
    features: Features,
    *,
    nose: Share = 1.0,
    lids: Share = 1.0,
    lips: Share = 0.6,
    around: Share = 0.8,
    brows: Share = 0.0,
    elsewhere: Share = 0.0,
) -> Mask:
    """The mask that `makeup.detail` blends detail maps by: share of the input's fine detail, H x W, 0 to 1.

    Args:
        nose, lids, lips, brows: share in that part. around: in the skin around the lips. elsewhere: in all other skin.
            Where parts overlap the largest share counts. In the openings of eyes and mouth it is 1.
    """
    shares = (
        (features.nose, nose),
        (features.lids, lids),
        (features.lips, lips),
        (features.around, around),
        (features.brows, brows),
    )
    mask = np.full_like(features.nose, elsewhere)
    for part, share in shares:
        mask = np.maximum(mask, part * np.float32(share))
    return np.maximum(mask, features.openings)
