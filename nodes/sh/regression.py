"""Weighted ridge regression of spherical-harmonic coefficients, plain or robust."""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.types import FloatArray

Robust = Literal["none", "huber", "trimmed"]


CONDITION_CAP = 1e12


_ROUNDS = 12
"""Of iterative reweighting, at most."""


_TOLERANCE = 1e-6
"""Relative change of the coefficients at which reweighting stops."""


_HUBER = 1.345
"""Huber's constant in standard deviations: 95 % efficiency for normally distributed errors."""


_NORMAL_CONSISTENCY = 1.4826
"""Standard deviation of a normal distribution over its median absolute deviation."""


def gram_matrix(design: FloatArray, weights: NDArray[np.float64]) -> NDArray[np.float64]:
    """Y^T W Y, (n, n)."""
    weighted = design * weights[:, None]
    gram: NDArray[np.float64] = weighted.T @ design.astype(np.float64)
    return gram


def condition_number(gram: NDArray[np.float64]) -> float:
    """Condition number of the design matrix behind a Gram matrix, at most `CONDITION_CAP`."""
    eigenvalues = np.linalg.eigvalsh(gram)
    largest, least = max(eigenvalues[-1], 0), max(eigenvalues[0], eigenvalues[-1] / CONDITION_CAP**2, 1e-300)
    return float(min(np.sqrt(largest / least), CONDITION_CAP))


def ridge_regression(
    design: FloatArray, values: FloatArray, weights: NDArray[np.float64], ridge: float
) -> NDArray[np.float64]:
    """argmin_c sum_x w(x) (s(x) - Y(x) c)^2 + ridge * sum_x w(x) * sum_{i > 0} c_i^2, in float64.

    Args:
        design: Y, (pixels, n). values: s, (pixels,) or (pixels, channels). weights: w, (pixels,).

    Returns:
        c, (n,) or (n, channels).
    """
    weighted = design * weights[:, None]
    total = max(float(weights.sum()), 1e-12)
    penalty = np.full(design.shape[1], ridge * total)
    penalty[0] = 1e-12 * total
    normal_matrix = gram_matrix(design, weights) + np.diag(penalty)
    return np.asarray(np.linalg.solve(normal_matrix, weighted.T @ values), np.float64)


def robust_regression(
    design: FloatArray, values: FloatArray, weights: NDArray[np.float64], ridge: float, robust: Robust, keep: float
) -> NDArray[np.float64]:
    """`ridge_regression`, repeated with weights from the residuals (iteratively reweighted least squares).

    "huber": weight min(1, k / |residual|), k = 1.345 robust standard deviations (Huber 1964). "trimmed": weight 1 for
    the share `keep` of the smallest residuals, 0 for the others (least trimmed squares, Rousseeuw 1984). "none": once.
    The channels of a pixel have one weight, by the largest of their residuals.
    """
    coefficients = ridge_regression(design, values, weights, ridge)
    for _ in range(_ROUNDS if robust != "none" else 0):
        residual = np.abs(np.asarray(values - design @ coefficients, np.float64))
        residual = residual.max(axis=1) if residual.ndim == 2 else residual
        if robust == "huber":
            limit = max(_HUBER * _NORMAL_CONSISTENCY * float(np.median(residual)), 1e-6)
            factor = np.minimum(1, limit / np.maximum(residual, limit))
        else:
            factor = (residual <= np.quantile(residual, keep)).astype(np.float64)
        if not float((weights * factor).sum()) > 1e-12:
            break
        before, coefficients = coefficients, ridge_regression(design, values, weights * factor, ridge)
        if np.abs(coefficients - before).max() <= _TOLERANCE * (1 + np.abs(before).max()):
            break
    return coefficients
