"""Structural similarity."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from numpy.typing import NDArray

from graphface import Figure, node
from graphface.nodes.metrics.comparison import Comparable, comparable_arrays, masked_mean, with_channel_axis
from graphface.nodes.types import Mask

_C1, _C2 = 0.01**2, 0.03**2
"""Stabilizing constants C_1 and C_2 for values in [0, 1]."""


_SIGMA = 1.5
"""Standard deviation of the Gaussian window, pixels."""


@node("metrics.ssim")
def ssim(result: Comparable, truth: Comparable, mask: Mask | None = None) -> Annotated[float, Figure("higher")]:
    """Structural similarity (Wang et al. 2004), at most 1; higher is better.

    Wang, Bovik, Sheikh, Simoncelli, Image Quality Assessment: From Error Visibility to Structural Similarity, TIP 2004,
    equation 13, averaged over the mask.

    Args:
        result, truth: values in [0, 1], H x W or H x W x 3.
        mask: weights, H x W.
    """
    one, other = (with_channel_axis(values) for values in comparable_arrays(result, truth))
    return ssim_terms(one, other, mask)[0]


def ssim_terms(one: NDArray[np.float64], other: NDArray[np.float64], mask: Mask | None) -> tuple[float, float]:
    """Mean similarity, and the mean of its contrast and structure term alone; arrays H x W x c."""
    import cv2

    def blurred(values: NDArray[np.float64]) -> NDArray[np.float64]:
        return with_channel_axis(cv2.GaussianBlur(values, (0, 0), _SIGMA, borderType=cv2.BORDER_REFLECT))

    mean, mean_other = blurred(one), blurred(other)
    variances = np.maximum(blurred(one * one) - mean * mean, 0) + np.maximum(
        blurred(other * other) - mean_other * mean_other, 0
    )
    contrast = (2 * (blurred(one * other) - mean * mean_other) + _C2) / (variances + _C2)
    luminance = (2 * mean * mean_other + _C1) / (mean * mean + mean_other * mean_other + _C1)
    return masked_mean(luminance * contrast, mask), masked_mean(contrast, mask)
