"""The paper's detail map: a difference."""

from __future__ import annotations

from graphface import node
from graphface.nodes.rendering import rendering
from graphface.nodes.types import Albedo, DetailMap, Image, Shading


@node("detail.additive")
def additive(photo: Image, albedo: Albedo, shading: Shading) -> DetailMap:
    """I_d(x) = I(x) - rho(x) SH(n(x), l_s) (paper, equation 4).

    Args:
        photo: I, in the encoding of albedo and shading.
        albedo: rho, H x W x 3.
        shading: SH(n, l_s), under the estimated light and spread over the whole picture, H x W or H x W x 3.
    """
    return DetailMap(offset=photo.pixels - rendering(albedo, shading))
