"""The 468 FaceMesh points on a model that has only the 68.

The built-in mean face is aligned to the model's by the points of both, and warped onto them by thin-plate splines. Each
of its points is assigned the nearest vertex. Points far from any vertex are left out.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.landmark_schemes import IBUG68_IN_FACEMESH468
from graphface.nodes.morphable.align import aligned
from graphface.nodes.morphable.model import MorphableModel
from graphface.nodes.morphable.topology import facemesh_topology

_NEAR = 0.06
"""Largest distance of a vertex from its point, in eye distances."""


_INNER = slice(17, 68)
"""The jaw points are left out: on many models they lie on the visible outline and not at a fixed point of the skin."""


def facemesh_on(model: MorphableModel) -> NDArray[np.int32]:
    """Vertices (468,) of the FaceMesh points on the model's mean face, -1 where none is near."""
    from scipy.interpolate import RBFInterpolator
    from scipy.spatial import cKDTree

    facemesh = facemesh_topology().mean.astype(np.float64)
    of_point = model.landmarks["ibug68"][_INNER]
    known = np.flatnonzero(of_point >= 0)
    here = IBUG68_IN_FACEMESH468[_INNER][known]
    there = model.mean[of_point[known]].astype(np.float64)
    weights = np.zeros(len(facemesh))
    weights[here] = 1
    target = np.zeros_like(facemesh)
    target[here] = there
    moved = aligned(facemesh[None], target, weights)[0][0]
    warp = RBFInterpolator(moved[here], there - moved[here], kernel="thin_plate_spline", smoothing=1e-3)
    distance, nearest = cKDTree(model.mean).query(moved + warp(moved))
    vertices = np.where(distance < _NEAR, nearest, -1).astype(np.int32)
    vertices[here] = of_point[known]
    return vertices
