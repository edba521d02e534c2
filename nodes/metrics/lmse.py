"""Local mean squared error."""

from __future__ import annotations

from typing import Annotated

import numpy as np

from graphface import Figure, node
from graphface.nodes.metrics.comparison import LEAST_ERROR, Comparable, comparable_arrays, with_channel_axis
from graphface.nodes.types import Mask

_WINDOW = 20
"""Pixels to a side, as in the paper."""


@node("metrics.lmse")
def lmse(result: Comparable, truth: Comparable, mask: Mask | None = None) -> Annotated[float, Figure("lower")]:
    """Local mean squared error: `si_mse` summed over half-overlapping windows, each with its own gain; lower is better.

    Grosse, Johnson, Adelson, Freeman, Ground Truth Dataset and Baseline Evaluations for Intrinsic Image Algorithms,
    ICCV 2009. Slowly varying errors of shading count little, misplaced edges count.

    Args:
        result, truth: H x W or H x W x 3.
        mask: weights, H x W.
    """
    wide, target = (with_channel_axis(values) for values in comparable_arrays(result, truth))
    weight = np.ones(wide.shape[:2]) if mask is None else mask.astype(np.float64)
    error = total = 0.0
    step = _WINDOW // 2
    for top in range(0, max(1, wide.shape[0] - step), step):
        for left in range(0, max(1, wide.shape[1] - step), step):
            part = np.s_[top : top + _WINDOW, left : left + _WINDOW]
            w, one, other = weight[part][..., None], wide[part], target[part]
            gain = (w * one * other).sum() / max((w * one * one).sum(), LEAST_ERROR)
            error += float((w * np.square(gain * one - other)).sum())
            total += float((w * np.square(other)).sum())
    return error / max(total, LEAST_ERROR)
