"""Least squares for a light that is not negative in any direction."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.harmonics import basis, sphere_points

DIRECTIONS = 600
"""Directions in which the light is constrained. Between them it may fall below 0 by 3 % of its mean."""


_RIDGE = 1e-6


def nonnegative_coefficients(
    coefficients: NDArray[np.float64], gram: NDArray[np.float64], order: int
) -> NDArray[np.float64]:
    """argmin (c - c0)^T M (c - c0) subject to G c >= 0, with the harmonics at `DIRECTIONS` points of the sphere as G.

    A least-distance problem, solved through its dual, a non-negative least-squares problem (Lawson and Hanson, Solving
    Least Squares Problems, 1974, chapter 23): with M = L L^T, z = argmin |L^-1 G^T z + L^T c0| over z >= 0, and
    c = c0 + M^-1 G^T z.

    Args:
        coefficients: c0, the unconstrained fit, (n,) or (n, channels).
        gram: M, the matrix of its normal equations, (n, n).

    Returns:
        c, of the shape of `coefficients`.
    """
    from scipy.optimize import nnls

    constraints = basis(sphere_points(DIRECTIONS), order)
    scale = max(float(np.trace(gram)) / len(gram), 1e-12)
    factor = np.linalg.cholesky(gram / scale + _RIDGE * np.eye(len(gram)))
    whitened = np.linalg.solve(factor, constraints.T)

    def constrained(start: NDArray[np.float64]) -> NDArray[np.float64]:
        if (constraints @ start).min() >= 0:
            return start
        multipliers, _ = nnls(whitened, -factor.T @ start)
        moved: NDArray[np.float64] = start + np.linalg.solve(factor.T, whitened @ multipliers)
        return moved

    columns = coefficients.reshape(len(coefficients), -1).T
    return np.stack([constrained(column) for column in columns], axis=1).reshape(coefficients.shape)
