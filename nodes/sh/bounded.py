"""A light that is nowhere negative: the nearest admissible one to an unconstrained fit."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.harmonics import basis, sphere_points

DIRECTIONS = 600


def nonnegative_coefficients(
    coefficients: NDArray[np.float64], gram: NDArray[np.float64], order: int
) -> NDArray[np.float64]:
    """argmin (c - c0)^T gram (c - c0) subject to G c >= 0, G the harmonics at `DIRECTIONS` points of the sphere.

    Least-distance programming through its dual, a non-negative least-squares problem (Lawson and Hanson, Solving Least
    Squares Problems, chapter 23): with gram = L L^T, c = c0 + gram^-1 G^T z, z = argmin |L^-1 G^T z + L^T c0|, z >= 0.

    Args:
        coefficients: the unconstrained fit, (n,) or (n, channels). gram: its normal matrix, (n, n).

    Returns:
        Of the same shape. Between the points the light may dip below zero by three percent of its mean.
    """
    from scipy.optimize import nnls

    bounds = basis(sphere_points(DIRECTIONS), order)
    scale = max(float(np.trace(gram)) / len(gram), 1e-12)
    factor = np.linalg.cholesky(gram / scale + 1e-6 * np.eye(len(gram)))
    spread = np.linalg.solve(factor, bounds.T)

    def bounded(start: NDArray[np.float64]) -> NDArray[np.float64]:
        if (bounds @ start).min() >= 0:
            return start
        force, _ = nnls(spread, -factor.T @ start)
        moved: NDArray[np.float64] = start + np.linalg.solve(factor.T, spread @ force)
        return moved

    columns = coefficients.reshape(len(coefficients), -1).T
    return np.stack([bounded(column) for column in columns], axis=1).reshape(coefficients.shape)
