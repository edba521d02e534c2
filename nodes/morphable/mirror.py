"""Which vertex of a symmetric model each vertex becomes in a mirror."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.morphable.model import MorphableModel

_TOLERANCE = 0.01
"""How far, in eye distances, a vertex may lie from its partner's mirror image."""


@lru_cache(maxsize=16)
def mirror_vertices(model: MorphableModel) -> NDArray[np.int32] | None:
    """Partners (V,), or None where the mean face is not symmetric about x = 0."""
    from scipy.spatial import cKDTree

    mean = model.mean.astype(np.float64)
    distance, partner = cKDTree(mean).query(mean * (-1, 1, 1))
    paired = partner[partner] == np.arange(len(mean))
    if distance.max() > _TOLERANCE or not paired.all():
        return None
    return np.asarray(partner, np.int32)
