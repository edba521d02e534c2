"""No detail map, for the paper's comparison "No Detail Map" (section 5.1)."""

from __future__ import annotations

import numpy as np

from graphface import node
from graphface.nodes.types import Albedo, DetailMap, Image, Shading


@node("detail.none")
def none(photo: Image, albedo: Albedo, shading: Shading) -> DetailMap:
    """A detail map of zeros: recombined it gives the rendering alone."""
    return DetailMap(offset=np.zeros_like(photo.pixels))
