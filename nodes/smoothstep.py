"""Smoothstep: a ramp between 0 and 1 without a kink."""

from __future__ import annotations

from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

T = TypeVar("T", bound=np.floating[Any])


def smoothstep(t: NDArray[T]) -> NDArray[T]:
    """3 t^2 - 2 t^3, the cubic Hermite ramp: 0 below 0, 1 above 1, of the shape and dtype of `t`.

    >>> smoothstep(np.float32([-1, 0.25, 0.5, 2]))
    array([0.     , 0.15625, 0.5    , 1.     ], dtype=float32)
    """
    t = np.clip(t, 0, 1)
    ramp: NDArray[T] = t * t * (3 - 2 * t)
    return ramp
