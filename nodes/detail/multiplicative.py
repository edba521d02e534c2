"""The shading ratio, which the paper's viewers found odd."""

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
    """The ratio I(x) / (rho(x) SH(n(x), theta)): the shading ratio of the paper's ablation (section 4.1).

    Args:
        floor: the least rendering that is divided by; what the bounded ratio cannot explain goes into the offset.
    """
    rendered = rendering(albedo, shading)
    gain = (photo.pixels / np.maximum(rendered, np.float32(floor))).astype(np.float32, copy=False)
    return DetailMap(offset=photo.pixels - gain * rendered, gain=gain)
