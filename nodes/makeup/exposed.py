"""The reference's detail map in the exposure of the painted face."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from graphface import node
from graphface.nodes.makeup.tone import Tone, lightness_ratio
from graphface.nodes.types import DetailMap, Mask, Shading


@node("makeup.exposed")
def exposed(detail: DetailMap, estimated: Shading, reference: Shading, mask: Mask, *, tone: Tone = 1.0) -> DetailMap:
    """The reference's detail map, scaled to the light in which `makeup.shading` renders the painted face.

    A detail map is a difference of intensities, so it is proportional to the exposure of the photo it was made from.

    Args:
        detail: the reference's, warped to the input.
        estimated: the input's shading. reference: the reference's, warped to the input. mask: where they are compared.
        tone: as for `makeup.shading`; at 1 the map is returned as it is.
    """
    if tone == 1:
        return detail
    factor = np.float32(lightness_ratio(estimated, reference, mask) ** (tone - 1))
    pivot = None if detail.pivot is None else detail.pivot * factor
    return replace(detail, offset=detail.offset * factor, pivot=pivot, ceiling=None)
