"""Angle between light directions."""

from __future__ import annotations

from typing import Annotated

import numpy as np

from graphface import Figure, node
from graphface.nodes.types import Direction

_LEAST_LENGTH = 1e-12


@node("metrics.light_angle")
def light_angle(result: Direction, truth: Direction) -> Annotated[float, Figure("lower", unit="°")]:
    """Angle between two light directions in degrees; lower is better.

    A zero vector has no direction; its angle to any other is 90.

    >>> round(light_angle(np.float32([1, 0, 0]), np.float32([1, 1, 0])), 3)
    45.0
    """
    lengths = float(np.linalg.norm(result)) * float(np.linalg.norm(truth))
    cosine = float(np.dot(result, truth)) / max(lengths, _LEAST_LENGTH)
    return float(np.degrees(np.arccos(np.clip(cosine, -1, 1))))
