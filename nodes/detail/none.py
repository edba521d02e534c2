"""No detail map, for the paper's ablation."""

from __future__ import annotations

import numpy as np

from graphface import node
from graphface.nodes.types import Albedo, DetailMap, Image, Shading


@node("detail.none")
def none(photo: Image, albedo: Albedo, shading: Shading) -> DetailMap:
    """No detail at all, for the paper's ablation: recombining gives the bare rendering."""
    return DetailMap(offset=np.zeros_like(photo.pixels))
