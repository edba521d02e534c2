"""How much of the reference's skin comes with its makeup: color by the albedo, lightness by the shading.

Where shading is intensity, albedo has no lightness, and the light fitted to a dark face is a dim one. So the tone that
a person's skin has is in two places, and both are moved by the same parameter.
"""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import warn
from graphface.nodes.color import channel_mean
from graphface.nodes.types import Mask, Shading

Tone = Annotated[float, Field(ge=0, le=1)]


_LEAST_LIGHT = 0.02


_MOST_RATIO = 8.0


def lightness(estimated: Shading, reference: Shading, mask: Mask) -> float:
    """Mean shading of the reference over that of the input, within 1/8 and 8; 1 where there is nothing to compare."""
    total = float(mask.sum(dtype=np.float64))
    if total < 1e-6:
        warn("makeup: the face mask is empty; the lightness of the two skins is taken as equal")
        return 1.0
    own, other = (
        float(np.einsum("hw,hw->", channel_mean(v), mask, dtype=np.float64)) / total for v in (estimated, reference)
    )
    return float(np.clip(max(other, _LEAST_LIGHT) / max(own, _LEAST_LIGHT), 1 / _MOST_RATIO, _MOST_RATIO))
