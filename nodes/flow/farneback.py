"""Polynomial expansion."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphface import node
from graphface.nodes.flow.refine import Length, Refinement, Resolution, refined
from graphface.nodes.types import Correspondence, Image, Landmarks


@node("flow.farneback")
def farneback(
    photo: Image,
    reference: Image,
    correspondence: Correspondence,
    landmarks: Landmarks,
    *,
    resolution: Resolution = 100,
    smoothing: Length = 0.1,
    tolerance: Length = 0.03,
    reach: Length = 0.15,
) -> Correspondence:
    """Farnebäck, Two-Frame Motion Estimation Based on Polynomial Expansion, SCIA 2003.

    The parameters are those of `graphface.nodes.flow.refine.Refinement`.
    """
    settings = Refinement(resolution=resolution, smoothing=smoothing, tolerance=tolerance, reach=reach)
    return refined(photo, reference, correspondence, landmarks, _flow, settings)


def _flow(one: NDArray[np.uint8], other: NDArray[np.uint8]) -> Any:
    import cv2

    return cv2.calcOpticalFlowFarneback(one, other, None, 0.5, 4, 25, 5, 7, 1.5, 0)  # type: ignore[call-overload]
