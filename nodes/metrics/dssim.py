"""Structural dissimilarity."""

from __future__ import annotations

from typing import Annotated

from graphface import Figure, node
from graphface.nodes.metrics.comparison import Comparable
from graphface.nodes.metrics.ssim import ssim
from graphface.nodes.types import Mask


@node("metrics.dssim")
def dssim(result: Comparable, truth: Comparable, mask: Mask | None = None) -> Annotated[float, Figure("lower")]:
    """Structural dissimilarity, (1 - SSIM) / 2, 0 to 1; lower is better.

    Args:
        result, truth: values in [0, 1], H x W or H x W x 3.
        mask: weights, H x W.
    """
    return (1 - ssim(result, truth, mask)) / 2
