"""Scale-invariant peak signal-to-noise ratio."""

from __future__ import annotations

from typing import Annotated

import numpy as np

from graphface import Figure, node
from graphface.nodes.metrics.comparison import LEAST_ERROR, Comparable, comparable_arrays, decibels, masked_mean
from graphface.nodes.types import Mask


@node("metrics.si_psnr")
def si_psnr(
    result: Comparable, truth: Comparable, mask: Mask | None = None
) -> Annotated[float, Figure("higher", unit="dB")]:
    """PSNR in dB after the gain on the result that minimizes the error, so exposure does not count; higher is better.

    Args:
        result, truth: values in [0, 1], H x W or H x W x 3.
        mask: weights, H x W.
    """
    result, truth = comparable_arrays(result, truth)
    wide = result.astype(np.float64)
    gain = masked_mean(wide * truth, mask) / max(masked_mean(wide * wide, mask), LEAST_ERROR)
    return decibels(masked_mean(np.square(gain * wide - truth), mask))
