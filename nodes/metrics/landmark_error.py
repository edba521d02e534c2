"""Error of landmarks."""

from __future__ import annotations

from typing import Annotated

import numpy as np

from graphface import Figure, node
from graphface.nodes.types import Landmarks


@node("metrics.landmark_error")
def landmark_error(result: Landmarks, truth: Landmarks) -> Annotated[float, Figure("lower")]:
    """Mean distance over the inter-ocular distance; lower is better.

    Distances are those in the picture (x and y), the inter-ocular distance is the truth's.

    Raises:
        ValueError: the two have different schemes or numbers of points.
    """
    if result.scheme != truth.scheme or result.points.shape != truth.points.shape:
        raise ValueError(f"landmarks of scheme {result.scheme} cannot be compared with {truth.scheme}")
    distance = np.linalg.norm(result.points[:, :2] - truth.points[:, :2], axis=1)
    return float(distance.mean()) / max(truth.interocular, 1e-3)
