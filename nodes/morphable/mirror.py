"""The mirror image of each vertex of a symmetric model."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.morphable.model import MorphableModel

_EXACT_TREE = 4
"""FLANN_INDEX_KDTREE_SINGLE, the only one of its trees with exact results."""


_TOLERANCE = 0.01
"""Largest distance of a vertex from its partner's mirror image, in eye distances."""


@lru_cache(maxsize=16)
def mirror_vertices(model: MorphableModel) -> NDArray[np.int32] | None:
    """Partners (V,), or None where the mean face is not symmetric about x = 0."""
    import cv2

    # OpenCV is loaded anyway, and importing SciPy's tree takes longer than a whole fit.
    mean = np.ascontiguousarray(model.mean, np.float32)
    tree = cv2.flann_Index(mean, {"algorithm": _EXACT_TREE})  # type: ignore[attr-defined]
    found, squared = tree.knnSearch(mean * np.array([-1, 1, 1], np.float32), 1, params={})
    partner = found[:, 0]
    paired = partner[partner] == np.arange(len(mean))
    if squared.max() > _TOLERANCE**2 or not paired.all():
        return None
    return np.asarray(partner, np.int32)
