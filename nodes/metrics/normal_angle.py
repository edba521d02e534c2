"""Angle between normals."""

from __future__ import annotations

from typing import Annotated

import numpy as np

from graphface import Figure, node
from graphface.nodes.types import Mask, Normals

_LEAST_LENGTH = 1e-12


@node("metrics.normal_angle")
def normal_angle(
    result: Normals, truth: Normals, mask: Mask | None = None
) -> Annotated[float, Figure("lower", unit="°")]:
    """Mean angle between normals in degrees; lower is better.

    Args:
        result, truth: H x W x 3 of any length; pixels where either is (0, 0, 0) do not count.
        mask: weights, H x W.

    Raises:
        ValueError: no pixel has both normals.
    """
    both = np.any(result != 0, axis=2) & np.any(truth != 0, axis=2)
    weights = both if mask is None else both * mask
    if not weights.any():
        raise ValueError("the two normal maps have no pixel in common")
    a, b = result.astype(np.float64), truth.astype(np.float64)
    lengths = np.linalg.norm(a, axis=2) * np.linalg.norm(b, axis=2)
    cosine = np.einsum("hwc,hwc->hw", a, b) / np.maximum(lengths, _LEAST_LENGTH)
    return float(np.average(np.degrees(np.arccos(np.clip(cosine, -1, 1))), weights=weights))
