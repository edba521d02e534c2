"""Peak signal-to-noise ratio."""

from __future__ import annotations

from typing import Annotated

import numpy as np

from graphface import Figure, node
from graphface.nodes.metrics.comparison import Comparable, comparable_arrays, decibels, masked_mean
from graphface.nodes.types import Mask


@node("metrics.psnr")
def psnr(
    result: Comparable, truth: Comparable, mask: Mask | None = None
) -> Annotated[float, Figure("higher", unit="dB")]:
    """PSNR in dB, at most 120; higher is better.

    Args:
        result, truth: values in [0, 1], H x W or H x W x 3.
        mask: weights, H x W.

    >>> round(psnr(np.full((2, 2), 0.5), np.full((2, 2), 0.6)), 3)
    20.0
    """
    result, truth = comparable_arrays(result, truth)
    return decibels(masked_mean(np.square(result.astype(np.float64) - truth), mask))
