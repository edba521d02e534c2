"""Total variation with an L1 data term."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphface import node
from graphface.nodes.flow.refine import Length, Refinement, Resolution, refined
from graphface.nodes.types import Correspondence, Image, Landmarks


@node("flow.tvl1")
def tvl1(
    photo: Image,
    reference: Image,
    correspondence: Correspondence,
    landmarks: Landmarks,
    *,
    resolution: Resolution = 60,
    smoothing: Length = 0.1,
    tolerance: Length = 0.03,
    reach: Length = 0.15,
) -> Correspondence:
    """Zach, Pock, Bischof, A Duality Based Approach for Realtime TV-L1 Optical Flow, DAGM 2007.

    The parameters are those of `graphface.nodes.flow.refine.Refinement`.
    """
    settings = Refinement(resolution=resolution, smoothing=smoothing, tolerance=tolerance, reach=reach)
    return refined(photo, reference, correspondence, landmarks, _flow, settings)


def _flow(one: NDArray[np.uint8], other: NDArray[np.uint8]) -> Any:
    import cv2

    return cv2.optflow.DualTVL1OpticalFlow_create().calc(one, other, None)  # type: ignore[attr-defined]
