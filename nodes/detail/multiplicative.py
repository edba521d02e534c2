"""The shading ratio, which the paper compares its detail map with."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node
from graphface.nodes.rendering import rendering
from graphface.nodes.types import Albedo, DetailMap, Image, Shading


@node("detail.multiplicative")
def multiplicative(
    photo: Image, albedo: Albedo, shading: Shading, *, floor: Annotated[float, Field(gt=0, le=1)] = 0.02
) -> DetailMap:
    """gain = I(x) / (rho(x) SH(n(x), l_s)), the shading ratio (paper, equation 7).

    Args:
        photo: I, in the encoding of albedo and shading.
        albedo: rho, H x W x 3.
        shading: SH(n, l_s), under the estimated light and spread over the whole picture, H x W or H x W x 3.
        floor: least rendering that is divided by; the offset holds the difference that this leaves.
    """
    rendered = rendering(albedo, shading)
    gain = (photo.pixels / np.maximum(rendered, np.float32(floor))).astype(np.float32, copy=False)
    return DetailMap(offset=photo.pixels - gain * rendered, gain=gain)
