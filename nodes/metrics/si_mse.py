"""Scale-invariant mean squared error."""

from __future__ import annotations

from typing import Annotated

import numpy as np

from graphface import Figure, node
from graphface.nodes.metrics.comparison import LEAST_ERROR, Comparable, comparable_arrays, masked_mean
from graphface.nodes.types import Mask


@node("metrics.si_mse")
def si_mse(result: Comparable, truth: Comparable, mask: Mask | None = None) -> Annotated[float, Figure("lower")]:
    """Squared error after the best gain over the mean square of the truth; lower is better.

    0 is the truth, 1 is as bad as black.

    Args:
        result, truth: H x W or H x W x 3.
        mask: weights, H x W.
    """
    result, truth = comparable_arrays(result, truth)
    wide, target = result.astype(np.float64), truth.astype(np.float64)
    gain = masked_mean(wide * target, mask) / max(masked_mean(wide * wide, mask), LEAST_ERROR)
    error = masked_mean(np.square(gain * wide - target), mask)
    return error / max(masked_mean(target * target, mask), LEAST_ERROR)
