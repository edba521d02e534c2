"""The prior over a face model's coefficients, learned from training faces."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.morphable.prior import Mixture


def fit_mixture(samples: NDArray[np.float64], *, most: int = 6, ridge: float = 0.05, seed: int = 0) -> Mixture:
    """The Gaussian mixture of samples (n, K); the form and number of components are chosen by BIC.

    Args:
        samples: coefficients of the training faces, in standard deviations.
        most: largest number of components that is tried.
        ridge: added to the variances, so that no component can collapse to a few faces.
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
