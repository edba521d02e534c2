"""The reference's detail map in the exposure of the painted face."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from graphface import node
from graphface.nodes.makeup.tone import Tone, lightness
from graphface.nodes.types import DetailMap, Mask, Shading


@node("makeup.exposed")
def exposed(detail: DetailMap, estimated: Shading, reference: Shading, mask: Mask, *, tone: Tone = 1.0) -> DetailMap:
    """The reference's detail map, as strong as it is under the light that `makeup.shading` gives.

    What the reference's skin shows in its own exposure is scaled with the lightness that it is rendered in.
    """
    if tone == 1:
        return detail
    factor = np.float32(lightness(estimated, reference, mask) ** (tone - 1))
    pivot = None if detail.pivot is None else detail.pivot * factor
    return replace(detail, offset=detail.offset * factor, pivot=pivot, ceiling=None)
