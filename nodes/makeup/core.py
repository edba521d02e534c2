"""The core: where the painted face is used as it is."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from graphface import Formerly, node, warn
from graphface.nodes.bounding_box import bounding_box
from graphface.nodes.smoothstep import smoothstep
from graphface.nodes.types import Correspondence, Features, Landmarks, Mask

_LEAST_SHARE_OF_BROW = 0.75
"""Share of a brow that must be usable; otherwise none of it is used."""


_LARGEST_HOLE = 0.3
"""Side of a square, in inter-ocular distances; smaller holes are filled."""


@node("makeup.core")
def core(
    mask: Mask,
    skin: Mask,
    correspondence: Correspondence,
    landmarks: Landmarks,
    features: Features | None = None,
    occluders: Annotated[Mask | None, Formerly("in_front")] = None,
    reference_skin: Annotated[Mask | None, Formerly("shown")] = None,
    *,
    shrink: Annotated[float, Field(ge=0, le=1)] = 0.0,
    softness: Annotated[float, Field(ge=0, le=1)] = 0.06,
) -> Mask:
    """Pixels of the input's skin that correspond to visible skin of the reference, without the rim of that area.

    A brow is used as a whole or not at all: half of the reference's beside half of the input's would look like two.

    Args:
        mask: a face mask of the input; where it is 0 the core is 0.
        skin: the input's skin. features: the input's.
        occluders: what covers the input's skin; the core is 0 where it is 1.
        reference_skin: the reference's visible skin, warped to the input. A point that both photos hide has a
            correspondence, but no skin to take.
        shrink: width of the rim that is left out. softness: width of the ramp from 0 to 1 inside of it; both in
            inter-ocular distances.

    Returns:
        H x W, 0 to 1; all 0, with a warning, if nothing corresponds.
    """
    import cv2

    unit = max(landmarks.interocular, 1e-3)
    usable = (correspondence.inside > 0) & (correspondence.known > 0.5) & (skin > 0.5) & (mask > 0)
    if reference_skin is not None:
        usable &= reference_skin > 0.5
    usable = _without_holes(usable, _LARGEST_HOLE * unit)
    if features is not None:
        usable &= ~_incomplete(features.brows > 0.1, usable)
    inside = np.zeros(mask.shape, np.float32)
    # One pixel of margin, so that depth is measured from outside; at the picture's border the face is only cut off.
    box = bounding_box(usable, margin=1)
    if box is None:
        warn("makeup.core: no pixel of the input's face has a counterpart in the reference; nothing is painted")
        return inside
    depth = np.asarray(cv2.distanceTransform(usable[box].astype(np.uint8), cv2.DIST_L2, 5), np.float32) - 0.5
    inside[box] = smoothstep((depth - shrink * unit) / max(softness * unit, 1.0))
    if occluders is not None:
        inside *= 1 - occluders
    return inside


def _without_holes(usable: NDArray[np.bool_], width: float) -> NDArray[np.bool_]:
    """Enclosed gaps up to `width` squared pixels filled: a fold that hides itself, as a nostril or a mouth's corner."""
    import cv2

    _, label, stats, _ = cv2.connectedComponentsWithStats((~usable).astype(np.uint8), connectivity=4)
    small = stats[:, cv2.CC_STAT_AREA] <= width * width
    small[0] = False
    filled: NDArray[np.bool_] = usable | small[label]
    return filled


def _incomplete(parts: NDArray[np.bool_], usable: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """The connected parts of which too small a share is usable."""
    import cv2

    count, label = cv2.connectedComponents(parts.astype(np.uint8), connectivity=8)
    total, left = (np.bincount(label[where], minlength=count) for where in (parts, parts & usable))
    incomplete = left < _LEAST_SHARE_OF_BROW * total
    incomplete[0] = False
    return np.asarray(incomplete[label])
