"""Where the 468 FaceMesh points lie on a model that only knows the 68.

The built-in mean face is moved onto the model's by the points that both know, bent to meet them exactly by thin-plate
splines, and each of its points takes the nearest vertex. Points that find none near by are left out.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.landmark_schemes import IBUG68_IN_FACEMESH468
from graphface.nodes.morphable.align import aligned
from graphface.nodes.morphable.model import MorphableModel
from graphface.nodes.morphable.topology import facemesh_topology

_NEAR = 0.06
"""A vertex further from its point than this, in eye distances, is another place on the face."""


_INNER = slice(17, 68)
"""The jaw points are left out: on many models they lie where the outline is seen, not at a place of the skin."""


def facemesh_on(model: MorphableModel) -> NDArray[np.int32]:
    """Vertices (468,) of the FaceMesh points on the model's mean face, -1 where none is near."""
    from scipy.interpolate import RBFInterpolator
    from scipy.spatial import cKDTree

    ours = facemesh_topology().mean.astype(np.float64)
    of_point = model.landmarks["ibug68"][_INNER]
    known = np.flatnonzero(of_point >= 0)
    here = IBUG68_IN_FACEMESH468[_INNER][known]
    there = model.mean[of_point[known]].astype(np.float64)
    share = np.zeros(len(ours))
    share[here] = 1
    target = np.zeros_like(ours)
    target[here] = there
    moved = aligned(ours[None], target, share)[0][0]
    bend = RBFInterpolator(moved[here], there - moved[here], kernel="thin_plate_spline", smoothing=1e-3)
    bent = moved + bend(moved)
    distance, nearest = cKDTree(model.mean).query(bent)
    vertices = np.where(distance < _NEAR, nearest, -1).astype(np.int32)
    vertices[here] = of_point[known]
    return vertices
