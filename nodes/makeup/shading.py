"""The light that the painted face is rendered under."""

from __future__ import annotations

import numpy as np

from graphface import node
from graphface.nodes.makeup.tone import Tone, lightness
from graphface.nodes.types import Features, Mask, Shading


@node("makeup.shading")
def shading(
    shading: Shading, estimated: Shading, reference: Shading, mask: Mask, features: Features, *, tone: Tone = 1.0
) -> Shading:
    """The light that the painted face is rendered under: `shading`, as much brighter as the reference's skin is.

    The openings of eyes and mouth are no skin, and keep the light they have.

    Args:
        shading: the input's own, spread over the picture, or that of a new scene.
        estimated: the input's own. reference: the reference's, warped to the input. mask: where they are compared.
        tone: share of the difference in lightness that is taken over.
    """
    opening = np.maximum(features.eyes, features.mouth)
    factor = 1 + np.float32(lightness(estimated, reference, mask) ** tone - 1) * (1 - opening)
    return shading * factor.reshape(*mask.shape, *[1] * (shading.ndim - 2))
