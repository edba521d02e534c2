"""Priors over coefficients: the paper's Gaussian mixture, and as a special case the single Gaussian (Tikhonov).

Fitting needs a quadratic bound. With the responsibilities r_k fixed at the current coefficients, the mixture's negative
logarithm lies below sum_k r_k |L_k^T (x - mean_k)|^2 / 2 and touches it there (the bound of expectation maximization),
so a step that lowers the bound lowers the negative logarithm.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from graphface import warn
from graphface.nodes.types import FloatArray

_LEAST_VARIANCE = 1e-4
"""Floor of a component's variances: coefficients are in standard deviations, so this is a hundredth of one."""


@dataclass(frozen=True)
class Mixture:
    """sum_k weights_k N(x; means_k, covariances_k): `weights` (C,), `means` (C, K), `covariances` (C, K, K) float32."""

    weights: FloatArray
    means: FloatArray
    covariances: FloatArray


@dataclass(frozen=True)
class Prepared:
    """A mixture in the form that solving needs: float64, with positive definite precisions.

    `log_weights` (C,) includes each component's normalization; `precisions` (C, K, K); `means` (C, K).
    """

    log_weights: NDArray[np.float64]
    means: NDArray[np.float64]
    precisions: NDArray[np.float64]


def standard(count: int) -> Mixture:
    """The standard normal distribution, whose quadratic is ridge regression."""
    return Mixture(np.ones(1, np.float32), np.zeros((1, count), np.float32), np.eye(count, dtype=np.float32)[None])


def prepare(mixture: Mixture, *, variance_floor: float = _LEAST_VARIANCE) -> Prepared:
    """Invert the covariances; eigenvalues below the floor are raised to it, with a warning."""
    values, vectors = np.linalg.eigh(mixture.covariances.astype(np.float64))
    singular = (values < variance_floor).any(axis=1)
    if singular.any():
        warn(f"{int(singular.sum())} of {len(values)} components of the prior are singular: their variances are raised")
    values = np.maximum(values, variance_floor)
    precisions = np.einsum("cik,ck,cjk->cij", vectors, 1 / values, vectors)
    weights = np.maximum(mixture.weights.astype(np.float64), 1e-12)
    log_weights = np.log(weights / weights.sum()) - 0.5 * np.log(values).sum(axis=1)
    return Prepared(log_weights, mixture.means.astype(np.float64), precisions)


def quadratic(prior: Prepared, x: NDArray[np.float64]) -> tuple[float, NDArray[np.float64], NDArray[np.float64]]:
    """Negative logarithm of the density at x (up to a constant), its gradient (K,) and the bound's Hessian (K, K)."""
    difference = x - prior.means
    gradients = np.einsum("cij,cj->ci", prior.precisions, difference)
    logs = prior.log_weights - 0.5 * np.einsum("ci,ci->c", difference, gradients)
    peak = logs.max()
    responsibilities = np.exp(logs - peak)
    total = responsibilities.sum()  # at least 1, that of the peak
    responsibilities /= total
    hessian = np.einsum("c,cij->ij", responsibilities, prior.precisions)
    return float(-peak - np.log(total)), responsibilities @ gradients, hessian


def marginal(mixture: Mixture, keep: NDArray[np.intp]) -> Mixture:
    """The marginal distribution of some of the coefficients, for a fit with fewer of them."""
    return replace(mixture, means=mixture.means[:, keep], covariances=mixture.covariances[:, keep[:, None], keep[None]])
