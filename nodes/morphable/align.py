"""Shapes aligned by position, scale and rotation: generalized Procrustes analysis."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def aligned(shapes: Array, target: Array, weights: Array | None = None) -> tuple[Array, Array]:
    """Each of the shapes (F, V, 3) aligned to `target` (V, 3) by translation, scale and rotation, by least squares.

    Args:
        weights: (V,) of the points; equal by default.

    Returns:
        The aligned shapes (F, V, 3) and the rotations (F, 3, 3) that were applied (Umeyama 1991; no reflections).
    """
    share = np.full(len(target), 1 / len(target)) if weights is None else weights / max(float(weights.sum()), 1e-12)
    middle = share @ target
    goal = target - middle
    centered = shapes - np.einsum("v,fvi->fi", share, shapes)[:, None]
    covariance = np.einsum("v,fvi,vj->fij", share, centered, goal)
    u, sizes, vt = np.linalg.svd(covariance)
    sign = np.sign(np.linalg.det(u @ vt))
    u[:, :, 2] *= sign[:, None]
    sizes[:, 2] *= sign
    rotations = u @ vt
    power = np.einsum("v,fvi,fvi->f", share, centered, centered)
    scale = sizes.sum(axis=1) / np.maximum(power, 1e-12)
    return scale[:, None, None] * centered @ rotations + middle, rotations


def procrustes_mean(shapes: Array, start: Array, *, rounds: int = 6) -> Array:
    """The mean of the shapes (F, V, 3) once aligned to it, in the frame and size of `start` (V, 3)."""
    mean = start
    for _ in range(rounds):
        mean = aligned(aligned(shapes, mean)[0].mean(axis=0)[None], start)[0][0]
    return mean
