"""Intersection over union."""

from __future__ import annotations

from typing import Annotated

import numpy as np

from graphface import Figure, node
from graphface.nodes.types import Mask

_LEAST_UNION = 1e-12


@node("metrics.iou")
def iou(result: Mask, truth: Mask) -> Annotated[float, Figure("higher")]:
    """Intersection over union of soft masks; higher is better.

    The sum of the minima over the sum of the maxima; 1 where both masks are empty.

    >>> iou(np.full((2, 2), 0.5, np.float32), np.ones((2, 2), np.float32))
    0.5
    """
    union = float(np.maximum(result, truth).sum(dtype=np.float64))
    return float(np.minimum(result, truth).sum(dtype=np.float64)) / union if union > _LEAST_UNION else 1.0
