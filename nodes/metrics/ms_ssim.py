"""Multi-scale structural similarity."""

from __future__ import annotations

from typing import Annotated

import numpy as np

from graphface import Figure, node
from graphface.nodes.metrics.comparison import Comparable, comparable_arrays, with_channel_axis
from graphface.nodes.metrics.ssim import ssim_terms
from graphface.nodes.types import Mask

_WEIGHTS = (0.0448, 0.2856, 0.3001, 0.2363, 0.1333)
"""Exponents of the scales, finest first (Wang et al. 2003)."""


_WINDOW = 11
"""Pixels to a side of the window of SSIM; a picture smaller than two of them is not halved."""


@node("metrics.ms_ssim")
def ms_ssim(result: Comparable, truth: Comparable, mask: Mask | None = None) -> Annotated[float, Figure("higher")]:
    """Multi-scale structural similarity (Wang et al. 2003), at most 1; higher is better.

    Wang, Simoncelli, Bovik, Multi-Scale Structural Similarity for Image Quality Assessment, Asilomar 2003, equation 7:
    five scales; fewer for small pictures, whose exponents are then scaled to sum to 1.

    Args:
        result, truth: values in [0, 1], H x W or H x W x 3.
        mask: weights, H x W.
    """
    import cv2

    one, other = (with_channel_axis(values) for values in comparable_arrays(result, truth))
    product, used = 1.0, 0.0
    for level, weight in enumerate(_WEIGHTS):
        whole, contrast = ssim_terms(one, other, mask)
        last = level == len(_WEIGHTS) - 1 or min(one.shape[:2]) < 2 * _WINDOW
        product *= max(whole if last else contrast, 0.0) ** weight
        used += weight
        if last:
            break
        size = (one.shape[1] // 2, one.shape[0] // 2)
        one, other = (with_channel_axis(cv2.resize(x, size, interpolation=cv2.INTER_AREA)) for x in (one, other))
        mask = None if mask is None else np.asarray(cv2.resize(mask, size, interpolation=cv2.INTER_AREA))
    return float(product ** (1 / used))
