"""How strongly each pixel is made up."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node
from graphface.nodes.types import Features, Mask

Strength = Annotated[float, Field(ge=0, le=1)]


@node("makeup.coverage")
def coverage(
    skin: Mask,
    features: Features,
    strengths: Mask | None = None,
    *,
    strength: Strength = 1.0,
    lips: Strength = 1.0,
    lids: Strength = 1.0,
    brows: Strength = 1.0,
    cheeks: Strength = 1.0,
    base: Strength = 1.0,
) -> Mask:
    """The opacity of the makeup layer, H x W, 0 to 1.

    Args:
        skin: where makeup may be applied.
        strengths: a user's own mask, multiplied on top.
        strength: of all. lips, lids (eye shadow), brows, cheeks, base (all other skin): of single parts.
    """
    amount = np.full_like(skin, base)
    for part, share in ((features.cheeks, cheeks), (features.lids, lids), (features.brows, brows)):
        amount += part * (np.float32(share) - amount)
    amount += np.maximum(features.lips, features.mouth) * (np.float32(lips) - amount)
    amount *= skin * np.float32(strength)
    return amount if strengths is None else amount * np.clip(strengths, 0, 1)
