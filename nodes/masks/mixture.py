"""Gaussian mixtures of weighted samples: one small classifier for each label of each picture.

Written out here rather than taken from scikit-learn for three reasons: samples carry weights (how sure we are that a
pixel is hair), the start is not random (a photo with a little noise must give nearly the same classifier), and
importing scikit-learn takes longer than segmenting. Every covariance has a floor, so a flat colour is a mixture too.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Mixture:
    """K Gaussians in D dimensions: `weights` (K,), `means` (K, D), `covariances` (K, D, D), all float64."""

    weights: Array
    means: Array
    covariances: Array

    def log_likelihood(self, samples: NDArray[np.floating]) -> NDArray[np.float32]:  # type: ignore[type-arg]
        """log p of each sample (n, D): float32 (n,)."""
        return _log_sum_exp(self.joint(samples)).astype(np.float32)

    def joint(self, samples: NDArray[np.floating]) -> Array:  # type: ignore[type-arg]
        """log of weight times density, (n, K)."""
        dimension = self.means.shape[1]
        columns = []
        for weight, mean, covariance in zip(self.weights, self.means, self.covariances, strict=True):
            lower = np.linalg.cholesky(covariance)
            whitening = np.linalg.inv(lower).T  # triangular, small, and floored below: no loss
            distance = np.square((samples - mean) @ whitening).sum(axis=1)
            normalizer = dimension * np.log(2 * np.pi) + 2 * np.log(np.diag(lower)).sum()
            columns.append(np.log(max(weight, 1e-12)) - 0.5 * (distance + normalizer))
        return np.stack(columns, axis=1)


def fit_mixture(
    samples: NDArray[np.floating],  # type: ignore[type-arg]
    weights: NDArray[np.floating] | None = None,  # type: ignore[type-arg]
    *,
    components: int = 4,
    rounds: int = 12,
    floor: float = 0.02,
) -> Mixture | None:
    """The mixture of at most `components` Gaussians that fits best, by expectation maximization.

    Args:
        samples: (n, D); a few thousand are enough. weights: (n,), at least 0; None: all 1.
        rounds: EM steps.
        floor: least standard deviation in any direction.

    Returns:
        None where there is no sample of positive weight. A single sample gives one Gaussian of the floor's width.
    """
    samples = np.asarray(samples, np.float64)
    weights = np.ones(len(samples)) if weights is None else np.asarray(weights, np.float64)
    used = (weights > 1e-6) & np.isfinite(samples).all(axis=1)
    samples, weights = samples[used], weights[used]
    if not len(samples):
        return None
    shares = _split(samples, weights, max(1, min(components, len(samples) // (2 * samples.shape[1]))), floor)
    mixture = _maximize(samples, weights, shares, floor)
    for _ in range(rounds if shares.shape[1] > 1 else 0):
        joint = mixture.joint(samples)
        mixture = _maximize(samples, weights, np.exp(joint - _log_sum_exp(joint)[:, None]), floor)
    return mixture


def _split(samples: Array, weights: Array, components: int, floor: float) -> Array:
    """A first assignment (n, K) of 0 and 1: the widest group is cut at its mean, across its widest direction, again
    and again. Nothing random."""
    group = np.zeros(len(samples), np.intp)
    for new in range(1, components):
        spreads = [_principal(samples[group == k], weights[group == k]) for k in range(new)]
        widest = int(np.argmax([variance * mass for variance, mass, _ in spreads]))
        variance, _, direction = spreads[widest]
        if variance <= floor**2:
            break
        member = np.flatnonzero(group == widest)
        along = samples[member] @ direction
        group[member[along > np.average(along, weights=weights[member])]] = new
    return np.eye(int(group.max()) + 1)[group]


def _principal(samples: Array, weights: Array) -> tuple[float, float, Array]:
    """Greatest variance, total weight, and the direction of that variance."""
    total = float(weights.sum())
    if len(samples) < 2 or total <= 0:
        return 0.0, total, np.zeros(samples.shape[1])
    centred = samples - np.average(samples, axis=0, weights=weights)
    values, vectors = np.linalg.eigh((centred * weights[:, None]).T @ centred / total)
    return float(values[-1]), total, vectors[:, -1]


def _maximize(samples: Array, weights: Array, shares: Array, floor: float) -> Mixture:
    """The Gaussians that fit samples best, given how much of each sample (n, K) every Gaussian answers for."""
    shares = shares * weights[:, None]
    mass = np.maximum(shares.sum(axis=0), 1e-9)
    means = shares.T @ samples / mass[:, None]
    covariances = []
    for k in range(shares.shape[1]):
        centred = samples - means[k]
        covariances.append((centred * shares[:, k, None]).T @ centred / mass[k] + floor**2 * np.eye(samples.shape[1]))
    return Mixture(mass / mass.sum(), means, np.stack(covariances))


def _log_sum_exp(joint: Array) -> Array:
    top = joint.max(axis=1)
    total: Array = top + np.log(np.exp(joint - top[:, None]).sum(axis=1))
    return total
