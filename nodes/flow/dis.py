"""Dense inverse search."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphface import node
from graphface.nodes.flow.refine import Length, Refinement, Resolution, refined
from graphface.nodes.types import Correspondence, Image, Landmarks


@node("flow.dis")
def dis(
    photo: Image,
    reference: Image,
    correspondence: Correspondence,
    landmarks: Landmarks,
    *,
    resolution: Resolution = 90,
    smoothing: Length = 0.1,
    tolerance: Length = 0.03,
    reach: Length = 0.15,
) -> Correspondence:
    """Kroeger, Timofte, Dai, Van Gool, Fast Optical Flow using Dense Inverse Search, ECCV 2016.

    The parameters are those of `graphface.nodes.flow.refine.Refinement`.
    """
    settings = Refinement(resolution=resolution, smoothing=smoothing, tolerance=tolerance, reach=reach)
    return refined(photo, reference, correspondence, landmarks, _flow, settings)


def _flow(one: NDArray[np.uint8], other: NDArray[np.uint8]) -> Any:
    import cv2

    return cv2.DISOpticalFlow_create(cv2.DISOPTICAL_FLOW_PRESET_MEDIUM).calc(one, other, None)  # type: ignore[attr-defined]
