"""Priors over coefficients: the paper's Gaussian mixture, and the single Gaussian (Tikhonov) as its plain case.

Fitting wants a quadratic: with the responsibilities held at the current coefficients, the mixture's negative logarithm
lies below sum_k r_k |L_k^T (x - mean_k)|^2 / 2 and touches it there (the bound of expectation-maximization), so a step
that lowers the quadratic lowers the prior.
"""

from __future__ import annotations

from collections.abc import Callable
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
    """A mixture made ready for solving: float64, precisions positive definite.

    `log_weights` (C,) includes each component's normalization; `precisions` (C, K, K); `means` (C, K).
    """

    log_weights: NDArray[np.float64]
    means: NDArray[np.float64]
    precisions: NDArray[np.float64]


def standard(count: int) -> Mixture:
    """The Gaussian of independent unit variances: ridge regression, in other words."""
    return Mixture(np.ones(1, np.float32), np.zeros((1, count), np.float32), np.eye(count, dtype=np.float32)[None])


def prepare(mixture: Mixture, *, variance_floor: float = _LEAST_VARIANCE) -> Prepared:
    """Invert the covariances, with eigenvalues lifted to the floor where a component is singular."""
    values, vectors = np.linalg.eigh(mixture.covariances.astype(np.float64))
    singular = (values < variance_floor).any(axis=1)
    if singular.any():
        warn(f"{int(singular.sum())} of {len(values)} components of the prior are singular: their variances are lifted")
    values = np.maximum(values, variance_floor)
    precisions = np.einsum("cik,ck,cjk->cij", vectors, 1 / values, vectors)
    weights = np.maximum(mixture.weights.astype(np.float64), 1e-12)
    log_weights = np.log(weights / weights.sum()) - 0.5 * np.log(values).sum(axis=1)
    return Prepared(log_weights, mixture.means.astype(np.float64), precisions)


def quadratic(prior: Prepared, x: NDArray[np.float64]) -> tuple[float, NDArray[np.float64], NDArray[np.float64]]:
    """Negative logarithm of the density at x (up to a constant), its gradient (K,) and the bound's Hessian (K, K)."""
    apart = x - prior.means
    pulled = np.einsum("cij,cj->ci", prior.precisions, apart)
    logs = prior.log_weights - 0.5 * np.einsum("ci,ci->c", apart, pulled)
    peak = logs.max()
    share = np.exp(logs - peak)
    total = share.sum()  # at least 1, the peak's own
    share /= total
    return float(-peak - np.log(total)), share @ pulled, np.einsum("c,cij->ij", share, prior.precisions)


def fit_mixture(samples: NDArray[np.float64], *, most: int = 6, ridge: float = 0.05, seed: int = 0) -> Mixture:
    """The Gaussian mixture of the samples (n, K), its form and number of components chosen by BIC.

    Args:
        samples: coefficients of the training faces, in standard deviations.
        most: components tried, 1 to this.
        ridge: added to the variances, so that no component can collapse on a few faces.
    """
    from sklearn.mixture import GaussianMixture

    tried = [
        GaussianMixture(count, covariance_type=form, reg_covar=ridge, random_state=seed, n_init=3).fit(samples)
        for form in ("full", "tied", "diag", "spherical")
        for count in range(1, min(most, max(1, len(samples) // 10)) + 1)
    ]
    best = min(tried, key=lambda mixture: float(mixture.bic(samples)))
    size = samples.shape[1]
    full: dict[str, Callable[[], NDArray[np.float64]]] = {
        "full": lambda: best.covariances_,
        "tied": lambda: np.repeat(best.covariances_[None], best.n_components, axis=0),
        "diag": lambda: np.stack([np.diag(v) for v in best.covariances_]),
        "spherical": lambda: best.covariances_[:, None, None] * np.eye(size),
    }
    covariances = full[best.covariance_type]()
    return Mixture(best.weights_.astype(np.float32), best.means_.astype(np.float32), covariances.astype(np.float32))


def leading(mixture: Mixture, keep: NDArray[np.intp]) -> Mixture:
    """The marginal of some coefficients: what a fit with fewer of them uses."""
    return replace(mixture, means=mixture.means[:, keep], covariances=mixture.covariances[:, keep[:, None], keep[None]])
