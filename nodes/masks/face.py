"""The face mask that needs nothing but the projected mesh."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node, warn
from graphface.nodes.types import Landmarks, Mask, Surface

Length = Annotated[float, Field(ge=0, le=2)]


@node("masks.face")
def face(surface: Surface, landmarks: Landmarks, *, shrink: Length = 0.02, softness: Length = 0.25) -> Mask:
    """Where the mesh lies in the picture, fading out towards its outline and never beyond it.

    Args:
        surface: gives the coverage; a face cut by the frame is not faded along the cut.
        shrink: width of the rim left out altogether, where normals graze and hair begins, in inter-ocular distances.
        softness: width of the fade inside of that rim, in inter-ocular distances.

    Returns:
        float32 H x W; 0 outside, a smooth step inside, 1 deeper than shrink + softness. Where the face is too small to
        have such an inside, the greatest value is less than 1 and positive.
    """
    import cv2

    covered = surface.coverage > 0.5
    if not covered.any():
        warn("masks.face: the mesh covers no pixel; the mask is empty")
        return np.zeros_like(surface.coverage)
    if covered.all():
        return np.ones_like(surface.coverage)
    inside = cv2.distanceTransform(covered.astype(np.uint8), cv2.DIST_L2, 5) - 0.5  # from pixel centres to the outline
    unit = max(landmarks.interocular, 1e-3)
    rim = min(shrink * unit, 0.5 * float(inside.max()))
    t = np.clip((inside - rim) / max(softness * unit, 1.0), 0, 1)
    mask: Mask = (t * t * (3 - 2 * t)).astype(np.float32)
    return mask
