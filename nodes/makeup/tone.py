"""How much of the reference's skin tone is transferred with its makeup: color in the albedo, lightness in the shading.

Where shading is intensity the albedo has no lightness, and the light estimated from a dark face is a dim one. So the
tone of a skin is in two places, and one parameter changes both.
"""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import warn
from graphface.nodes.color import channel_mean
from graphface.nodes.types import Mask, Shading

Tone = Annotated[float, Field(ge=0, le=1)]


_LEAST_LIGHTNESS = 0.02


_LARGEST_RATIO = 8.0


def lightness_ratio(estimated: Shading, reference: Shading, mask: Mask) -> float:
    """Mean shading of the reference over that of the input, each weighted by the mask; within 1/8 and 8.

    Args:
        estimated, reference: H x W or H x W x 3. mask: H x W; where it is empty the ratio is 1, with a warning.

    >>> input_shading, reference_shading = (np.full((2, 2), v, np.float32) for v in (0.25, 0.5))
    >>> lightness_ratio(input_shading, reference_shading, np.ones((2, 2), np.float32))
    2.0
    """
    total = float(mask.sum(dtype=np.float64))
    if total < 1e-6:
        warn("makeup: the face mask is empty; the lightness of the two skins is taken as equal")
        return 1.0
    of_input, of_reference = (
        float(np.einsum("hw,hw->", channel_mean(values), mask, dtype=np.float64)) / total
        for values in (estimated, reference)
    )
    ratio = max(of_reference, _LEAST_LIGHTNESS) / max(of_input, _LEAST_LIGHTNESS)
    return float(np.clip(ratio, 1 / _LARGEST_RATIO, _LARGEST_RATIO))
