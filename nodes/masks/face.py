"""The face mask that needs only the projected mesh."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node, warn
from graphface.nodes.types import Landmarks, Mask, Surface

Length = Annotated[float, Field(ge=0, le=2)]


@node("masks.face")
def face(surface: Surface, landmarks: Landmarks, *, shrink: Length = 0.02, softness: Length = 0.25) -> Mask:
    """The area of the mesh in the picture, with a soft edge that lies inside the mesh.

    Args:
        surface: gives the coverage. Where the frame cuts the face there is no soft edge.
        shrink: width of the outermost rim where the mask is 0, in inter-ocular distances. There normals are at grazing
            angles and hair begins.
        softness: width of the ramp inside that rim, in inter-ocular distances.

    Returns:
        float32 H x W; 0 outside, a smooth step inside, 1 deeper than shrink + softness. In a face too small for that
        the greatest value is less than 1 and positive.
    """
    import cv2

    covered = surface.coverage > 0.5
    if not covered.any():
        warn("masks.face: the mesh covers no pixel; the mask is empty")
        return np.zeros_like(surface.coverage)
    if covered.all():
        return np.ones_like(surface.coverage)
    depth = cv2.distanceTransform(covered.astype(np.uint8), cv2.DIST_L2, 5) - 0.5  # from pixel centers to the outline
    unit = max(landmarks.interocular, 1e-3)
    rim = min(shrink * unit, 0.5 * float(depth.max()))
    t = np.clip((depth - rim) / max(softness * unit, 1.0), 0, 1)
    mask: Mask = (t * t * (3 - 2 * t)).astype(np.float32)
    return mask
