"""Alphas from a sparse symmetric system, by conjugate gradients with a fallback."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphface import warn
from graphface.nodes.matting.two_level import TwoLevel, Vector
from graphface.nodes.types import FloatArray

STEPS = 500
"""Largest number of steps of conjugate gradients."""


def solve_alphas(
    system: Any, right: NDArray[np.float64], guess: FloatArray, *, tolerance: float, coarse: Any | None = None
) -> FloatArray:
    """The x that solves system x = right, float32 (n, columns of `right`).

    Args:
        system: CSR (n, n), symmetric, with a positive diagonal. guess: (n, k) in [0, 1], where the iteration starts.
        coarse: sparse (n, m), functions nearly in the system's null space (see `two_level`).
        tolerance: relative residual.

    Returns:
        The last iterate, with a warning, where the iteration does not converge; the guess, with a warning, where the
        solution is not finite.
    """
    initial = guess.astype(np.float64)
    if not len(initial):
        return initial.astype(np.float32)
    system.sum_duplicates()
    inverse = TwoLevel(system, coarse)
    alphas = np.empty_like(initial)
    for k in range(initial.shape[1]):
        first = np.ascontiguousarray(initial[:, k])
        x, converged = _conjugate_gradients(system, right[:, k], first, inverse, tolerance)
        if not converged:
            warn(f"matting: conjugate gradients did not reach {tolerance:g}; the last iterate is used")
        if not np.isfinite(x).all():
            warn("matting: the solution is not finite; the soft labels are used")
            x = first
        alphas[:, k] = x
    return alphas.astype(np.float32)


def _conjugate_gradients(
    system: Any, target: Vector, initial: Vector, inverse: TwoLevel, tolerance: float
) -> tuple[Vector, bool]:
    """The solution, iterated from `initial`, and whether it reached the tolerance.

    Inner products use einsum: BLAS would wake its threads, which costs more than it saves at these sizes.
    """
    residual = target - system @ initial
    least = max(tolerance**2 * max(_dot(target, target), _dot(residual, residual)), 1e-24)
    correction, image = inverse.start(residual)
    x, residual = initial + correction, residual - image
    direction, previous = np.zeros_like(x), 1.0
    for _ in range(STEPS):
        squared = _dot(residual, residual)
        if not squared > least:  # reached, or NaN
            return x, squared <= least
        preconditioned = inverse(residual)
        slope = _dot(residual, preconditioned)
        direction *= slope / previous
        direction += preconditioned
        previous = slope if abs(slope) > 1e-300 else 1e-300
        image = system @ direction
        step = slope / max(_dot(direction, image), 1e-300)
        x += step * direction
        residual -= step * image
    return x, False


def _dot(a: Vector, b: Vector) -> float:
    return float(np.einsum("n,n->", a, b))
