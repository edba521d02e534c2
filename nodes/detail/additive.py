"""The paper's detail map: a difference."""

from __future__ import annotations

from graphface import node
from graphface.nodes.rendering import rendering
from graphface.nodes.types import Albedo, DetailMap, Image, Shading


@node("detail.additive")
def additive(photo: Image, albedo: Albedo, shading: Shading) -> DetailMap:
    """I_d(x) = I(x) - rho(x) SH(n(x), theta) (paper, section 2, "Face detail map").

    Args:
        photo: in the encoding that albedo and shading were made in.
        shading: the estimated light's, H x W or H x W x 3, spread over the whole picture.
    """
    return DetailMap(offset=photo.pixels - rendering(albedo, shading))
