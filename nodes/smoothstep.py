"""Smoothstep: a ramp between 0 and 1 without a kink."""

from __future__ import annotations

import numpy as np

from graphface.nodes.types import FloatArray


def smoothstep(t: FloatArray) -> FloatArray:
    """3 t^2 - 2 t^3, the cubic Hermite ramp: 0 below 0, 1 above 1, float32 of the shape of `t`.

    >>> smoothstep(np.float32([-1, 0.25, 0.5, 2]))
    array([0.     , 0.15625, 0.5    , 1.     ], dtype=float32)
    """
    t = np.clip(t, 0, 1)
    return t * t * (3 - 2 * t)
