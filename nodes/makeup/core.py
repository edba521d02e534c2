"""Where the painted face may be taken as it is."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from graphface import node, warn
from graphface.nodes.types import Correspondence, Features, Landmarks, Mask

_WHOLE = 0.75
"""Share of a brow that must be usable for any of it to be."""


@node("makeup.core")
def core(
    mask: Mask,
    skin: Mask,
    correspondence: Correspondence,
    landmarks: Landmarks,
    features: Features | None = None,
    in_front: Mask | None = None,
    shown: Mask | None = None,
    *,
    shrink: Annotated[float, Field(ge=0, le=1)] = 0.0,
    softness: Annotated[float, Field(ge=0, le=1)] = 0.06,
) -> Mask:
    """Where the painted face is taken as it is: inside the mesh, off its rim, on skin that the reference shows.

    A brow is painted whole or not at all: half of the reference's beside half of the input's makes two.

    Args:
        mask: a face mask of the input; where it is 0 nothing is core.
        skin: the input's skin. features: the input's. in_front: what is in front of its skin.
        shown: the reference's skin, warped to the input: what both hide corresponds, and is not painted all the same.
        shrink, softness: width of the rim that is left out and of the way to it, in
            inter-ocular distances.
    """
    import cv2

    unit = max(landmarks.interocular, 1e-3)
    usable = (correspondence.inside > 0) & (correspondence.known > 0.5) & (skin > 0.5) & (mask > 0)
    if shown is not None:
        usable &= shown > 0.5
    usable = _without_holes(usable, 0.3 * unit)
    if features is not None:
        usable &= ~_cut(features.brows > 0.1, usable)
    if not usable.any():
        warn("makeup.core: no pixel of the input's face has a counterpart in the reference; nothing is painted")
        return np.zeros_like(mask)
    rows, columns = np.flatnonzero(usable.any(axis=1)), np.flatnonzero(usable.any(axis=0))
    # One pixel more all around, so that the depth is known; at the picture's edge the face is only cut off.
    window = tuple(slice(max(0, n[0] - 1), n[-1] + 2) for n in (rows, columns))
    depth = cv2.distanceTransform(usable[window].astype(np.uint8), cv2.DIST_L2, 5) - 0.5
    t = np.clip((depth - shrink * unit) / max(softness * unit, 1.0), 0, 1)
    inside = np.zeros(mask.shape, np.float32)
    inside[window] = t * t * (3 - 2 * t)
    if in_front is not None:
        inside *= 1 - in_front
    return inside


def _without_holes(usable: NDArray[np.bool_], width: float) -> NDArray[np.bool_]:
    """Enclosed gaps filled, up to a width: a fold that hides itself (nostril, corner of the mouth) is painted along."""
    import cv2

    _, label, stats, _ = cv2.connectedComponentsWithStats((~usable).astype(np.uint8), connectivity=4)
    small = stats[:, cv2.CC_STAT_AREA] <= width * width
    small[0] = False
    filled: NDArray[np.bool_] = usable | small[label]
    return filled


def _cut(parts: NDArray[np.bool_], usable: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Those parts too little of which is usable."""
    import cv2

    count, label = cv2.connectedComponents(parts.astype(np.uint8), connectivity=8)
    total, left = (np.bincount(label[where], minlength=count) for where in (parts, parts & usable))
    cut = left < _WHOLE * total
    cut[0] = False
    return np.asarray(cut[label])
