"""Which vertex of a symmetric model each vertex becomes in a mirror."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.morphable.model import MorphableModel

_EXACT_TREE = 4
"""FLANN_INDEX_KDTREE_SINGLE, the one of its trees that always finds the nearest."""


_TOLERANCE = 0.01
"""How far, in eye distances, a vertex may lie from its partner's mirror image."""


@lru_cache(maxsize=16)
def mirror_vertices(model: MorphableModel) -> NDArray[np.int32] | None:
    """Partners (V,), or None where the mean face is not symmetric about x = 0."""
    import cv2

    # OpenCV's tree, since it is loaded anyway: importing scipy's takes longer than all of a fit.
    mean = np.ascontiguousarray(model.mean, np.float32)
    tree = cv2.flann_Index(mean, {"algorithm": _EXACT_TREE})  # type: ignore[attr-defined]
    found, squared = tree.knnSearch(mean * np.array([-1, 1, 1], np.float32), 1, params={})
    partner = found[:, 0]
    paired = partner[partner] == np.arange(len(mean))
    if squared.max() > _TOLERANCE**2 or not paired.all():
        return None
    return np.asarray(partner, np.int32)
