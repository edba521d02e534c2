"""The detail map: what the photo has and the rendering of albedo, geometry and light lacks.

Every method answers the same question, photo = gain * rendering + offset, and differs in what goes where. The equation
holds exactly for `additive` and `multiplicative`, so that recombining with the same shading returns the photo.
"""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node
from graphface.nodes.types import Albedo, DetailMap, FloatArray, Image, Shading


@node("detail.additive")
def additive(photo: Image, albedo: Albedo, shading: Shading) -> DetailMap:
    """I_d(x) = I(x) - rho(x) SH(n(x), theta) (paper, section 2, "Face detail map").

    Args:
        photo: in the encoding that albedo and shading were made in.
        shading: the estimated light's, H x W or H x W x 3, spread over the whole picture.
    """
    return DetailMap(offset=photo.pixels - rendering(albedo, shading))


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


@node("detail.none")
def none(photo: Image, albedo: Albedo, shading: Shading) -> DetailMap:
    """No detail at all, for the paper's ablation: recombining gives the bare rendering."""
    return DetailMap(offset=np.zeros_like(photo.pixels))


def rendering(albedo: Albedo, shading: Shading) -> FloatArray:
    """rho(x) s(x), H x W x 3, for a grey (H x W) or coloured (H x W x 3) shading."""
    return albedo * (shading if shading.ndim == 3 else shading[..., None])
