"""Gaussian mixtures of weighted samples: one small classifier for each label of each picture.

This is not scikit-learn's, for three reasons: samples have weights (the probability that a pixel is hair); the
initialization is not random (a photo with a little noise must give nearly the same classifier); importing scikit-learn
takes longer than segmenting. Every covariance has a floor, so a flat color is a mixture too.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


Samples = NDArray[np.floating[Any]]


MULTIPLICATIONS = 1 << 17
"""In one matrix product. Above twice this number OpenBLAS starts threads. They and the engine's own threads wait for
each other; with all cores busy that was measured to take fifty times as long."""


@dataclass(frozen=True)
class Mixture:
    """K Gaussians in D dimensions: `weights` (K,), `means` (K, D), `covariances` (K, D, D), all float64."""

    weights: Array
    means: Array
    covariances: Array

    def log_likelihood(self, samples: Samples) -> NDArray[np.float32]:
        """log p of each sample (n, D): float32 (n,)."""
        return _log_sum_exp(self.joint(samples))

    def joint(self, samples: Samples) -> NDArray[np.float32]:
        """log of weight times density of each Gaussian, float32 (n, K).

        All Gaussians are evaluated in one product: with W W^T = inverse covariance, the Mahalanobis distance is
        |W^T x - W^T mean|^2.
        """
        count, dimension = self.means.shape
        lower = np.linalg.cholesky(self.covariances)  # floored, so small and well-conditioned
        whitening = np.linalg.inv(lower).transpose(2, 0, 1).reshape(dimension, count * dimension)
        middle = self.weights @ self.means
        shifts = np.einsum("kij,kj->ki", np.linalg.inv(lower), self.means - middle).reshape(-1)
        spread = np.log(np.diagonal(lower, axis1=1, axis2=2)).sum(axis=1)
        heights = np.log(np.maximum(self.weights, 1e-12)) - 0.5 * dimension * np.log(2 * np.pi) - spread
        summing = np.repeat(np.eye(count, dtype=np.float32), dimension, axis=0)
        samples = np.asarray(samples, np.float32)
        found = np.empty((len(samples), count), np.float32)
        step = max(1, MULTIPLICATIONS // (count * dimension**2))
        for start in range(0, len(samples), step):
            white = (samples[start : start + step] - np.float32(middle)) @ np.float32(whitening) - np.float32(shifts)
            found[start : start + step] = np.float32(heights) - (white * white) @ summing / 2
        return found


def fit_mixture(
    samples: Samples,
    weights: Samples | None = None,
    *,
    components: int = 4,
    rounds: int = 6,
    floor: float = 0.02,
) -> Mixture | None:
    """A mixture of Gaussians by expectation maximization.

    Args:
        samples: (n, D); a few thousand are enough. weights: (n,), at least 0; None: all 1.
        components: at most this many Gaussians; the largest power of two within it, fewer for few samples.
        rounds: steps of expectation maximization.
        floor: least standard deviation in any direction.

    Returns:
        None where there is no sample of positive weight. A single sample gives one Gaussian of the floor's width.
    """
    points: Array = np.asarray(samples, np.float64)
    mass: Array = np.ones(len(points)) if weights is None else np.asarray(weights, np.float64)
    used = (mass > 1e-6) & np.isfinite(points).all(axis=1)
    points, mass = points[used], mass[used]
    if not len(points):
        return None
    shares = _split(points, mass, max(1, min(components, len(points) // (2 * points.shape[1]))), floor)
    mixture = _maximize(points, mass, shares, floor)
    for _ in range(rounds if shares.shape[1] > 1 else 0):
        joint = mixture.joint(points)
        mixture = _maximize(points, mass, np.exp(joint - _log_sum_exp(joint)[:, None]), floor)
    return mixture


def with_lightness_spread(mixture: Mixture, spread: float) -> Mixture:
    """The mixture with a further standard deviation `spread` along the first feature, which is lightness."""
    covariances = mixture.covariances.copy()
    covariances[:, 0, 0] += spread**2
    return Mixture(mixture.weights, mixture.means, covariances)


def _split(samples: Array, weights: Array, components: int, floor: float) -> Array:
    """A first assignment (n, K) of 0 and 1. Every group is cut at its mean across its first principal axis, repeatedly.

    Nothing is random, and a little noise cannot flip a choice between groups.
    """
    group = np.zeros(len(samples), np.intp)
    count = 1
    while 2 * count <= components:
        for k in range(count):
            member = np.flatnonzero(group == k)
            variance, direction = _principal(samples[member], weights[member])
            if variance > floor**2:
                along = samples[member] @ direction
                group[member[along > np.average(along, weights=weights[member])]] = count + k
        count *= 2
    return np.eye(count)[group][:, np.unique(group)]


def _principal(samples: Array, weights: Array) -> tuple[float, Array]:
    """The largest variance in any direction, and that direction."""
    total = float(weights.sum())
    if len(samples) < 2 or total <= 0:
        return 0.0, np.zeros(samples.shape[1])
    centred = samples - np.average(samples, axis=0, weights=weights)
    values, vectors = np.linalg.eigh((centred * weights[:, None]).T @ centred / total)
    return float(values[-1]), vectors[:, -1]


def _maximize(samples: Array, weights: Array, shares: Array, floor: float) -> Mixture:
    """The Gaussians of maximal likelihood, given the responsibilities `shares` (n, K) of each for every sample."""
    shares = shares * weights[:, None]
    mass = np.maximum(shares.sum(axis=0), 1e-9)
    means = shares.T @ samples / mass[:, None]
    covariances = []
    for k in range(shares.shape[1]):
        centred = samples - means[k]
        covariances.append((centred * shares[:, k, None]).T @ centred / mass[k] + floor**2 * np.eye(samples.shape[1]))
    return Mixture(mass / mass.sum(), means, np.stack(covariances))


def _log_sum_exp(joint: NDArray[np.float32]) -> NDArray[np.float32]:
    top = joint[:, 0]
    for k in range(1, joint.shape[1]):
        top = np.maximum(top, joint[:, k])  # several times faster than `max` over so short an axis
    return np.asarray(top + np.log(np.exp(joint - top[:, None]).sum(axis=1)), np.float32)
