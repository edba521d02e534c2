"""The light that the painted face is rendered under."""

from __future__ import annotations

import numpy as np

from graphface import node
from graphface.nodes.makeup.tone import Tone, lightness_ratio
from graphface.nodes.types import Features, Mask, Shading


@node("makeup.shading")
def shading(
    shading: Shading, estimated: Shading, reference: Shading, mask: Mask, features: Features, *, tone: Tone = 1.0
) -> Shading:
    """The shading, multiplied by the ratio of the two skins' lightness; not in the openings of eyes and mouth.

    Args:
        shading: the input's own, spread over the picture, or that of a new scene; H x W or H x W x 3.
        estimated: the input's own. reference: the reference's, warped to the input. mask: where the two are compared.
        tone: share of the difference in lightness that is transferred.
    """
    ratio = np.float32(lightness_ratio(estimated, reference, mask) ** tone - 1)
    factor = 1 + ratio * (1 - features.openings)
    return shading * factor.reshape(*mask.shape, *[1] * (shading.ndim - 2))
