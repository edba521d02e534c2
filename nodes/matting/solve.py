"""Alphas from a sparse symmetric system: conjugate gradients that always come back with an answer."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphface import warn
from graphface.nodes.matting.two_level import TwoLevel, Vector
from graphface.nodes.types import FloatArray

STEPS = 500
"""Most steps of conjugate gradients."""


def solve_alphas(
    system: Any, right: NDArray[np.float64], guess: FloatArray, *, tolerance: float, coarse: Any | None = None
) -> FloatArray:
    """The x that solves system x = right, float32 (n, columns of `right`).

    Args:
        system: CSR (n, n), symmetric, with a positive diagonal. guess: (n, k) in [0, 1], where the solve starts.
        coarse: sparse (n, m), functions that the system hardly resists.
        tolerance: relative residual.

    Falls back, with a warning, on the last iterate where the solve does not converge, and on the guess where it is not
    finite.
    """
    begun = guess.astype(np.float64)
    if not len(begun):
        return begun.astype(np.float32)
    system.sum_duplicates()
    inverse = TwoLevel(system, coarse)
    alphas = np.empty_like(begun)
    for k in range(begun.shape[1]):
        first = np.ascontiguousarray(begun[:, k])
        x, converged = _conjugate_gradients(system, right[:, k], first, inverse, tolerance)
        if not converged:
            warn(f"matting: conjugate gradients stopped short of {tolerance:g}; alphas are taken as they are")
        if not np.isfinite(x).all():
            warn("matting: the solve is not finite; the labels' own softness is taken")
            x = first
        alphas[:, k] = x
    return alphas.astype(np.float32)


def _conjugate_gradients(
    system: Any, target: Vector, begun: Vector, inverse: TwoLevel, tolerance: float
) -> tuple[Vector, bool]:
    """The solution from `begun` on, and whether it reached the tolerance.

    Inner products are einsum's: those of BLAS wake its threads, which costs more than it saves at these sizes.
    """
    residual = target - system @ begun
    least = max(tolerance**2 * max(_dot(target, target), _dot(residual, residual)), 1e-24)
    correction, image = inverse.start(residual)
    x, residual = begun + correction, residual - image
    direction, along = np.zeros_like(x), 1.0
    for _ in range(STEPS):
        left = _dot(residual, residual)
        if not left > least:  # reached, or no longer a number
            return x, left <= least
        better = inverse(residual)
        slope = _dot(residual, better)
        direction *= slope / along
        direction += better
        along = slope if abs(slope) > 1e-300 else 1e-300
        image = system @ direction
        step = slope / max(_dot(direction, image), 1e-300)
        x += step * direction
        residual -= step * image
    return x, False


def _dot(a: Vector, b: Vector) -> float:
    return float(np.einsum("n,n->", a, b))
