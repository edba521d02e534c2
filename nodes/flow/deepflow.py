"""DeepFlow, as OpenCV has it (variational, without the matching of patches)."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphface import node
from graphface.nodes.flow.refine import Length, Refinement, Resolution, refined
from graphface.nodes.types import Correspondence, Image, Landmarks


@node("flow.deepflow")
def deepflow(
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
    """Weinzaepfel, Revaud, Harchaoui, Schmid, DeepFlow, ICCV 2013.

    The parameters are those of `graphface.nodes.flow.refine.Refinement`.
    """
    settings = Refinement(resolution=resolution, smoothing=smoothing, tolerance=tolerance, reach=reach)
    return refined(photo, reference, correspondence, landmarks, _flow, settings)


def _flow(one: NDArray[np.uint8], other: NDArray[np.uint8]) -> Any:
    import cv2

    return cv2.optflow.createOptFlow_DeepFlow().calc(one, other, None)  # type: ignore[call-overload]
