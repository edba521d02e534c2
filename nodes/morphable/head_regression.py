"""A head by the points of its face: the mean of a Gaussian process given noisy points.

Lüthi, Gerig, Jud, Vetter, Gaussian Process Morphable Models, TPAMI 2018: the prior of a shape is a mean, identities
with normal coefficients, and a smooth displacement with a squared exponential kernel, which takes up expressions and
what the identities lack. All is linear, so the posterior mean at every vertex is known in closed form.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.morphable.model import MorphableModel

Array = NDArray[np.float64]


class Prior(NamedTuple):
    """Lengths in eye distances: `deviation` and `width` of the smooth displacement; standard deviations of a point's
    error across and in depth; `identity`, the number of identities."""

    deviation: float
    width: float
    noise: float
    depth_noise: float
    identity: int


@dataclass(frozen=True)
class HeadRegression:
    """What does not depend on the points. V vertices, n points, K identities.

    `mean` (V, 3), `identity` (K, V, 3), `kernel` (V, n) of the surface; `points` (n, 3), `of_points` (K, n, 3),
    `smooth` (n, n) of the points; `precision` (3, n, n): inverse covariance of the smooth displacement with noise, for
    x, y, z; `normal` (K, K): the equations of the coefficients.
    """

    mean: Array
    identity: NDArray[np.float32]
    kernel: NDArray[np.float32]
    points: Array
    of_points: Array
    smooth: Array
    precision: Array
    normal: Array

    def coefficients(self, points: Array) -> tuple[Array, Array]:
        """Identity (K,) and the weights (n, 3) of the kernels, for points (n, 3) in the model's frame."""
        off = points - self.points
        weighted = np.einsum("cmn,nc->mc", self.precision, off)
        identity = np.linalg.solve(self.normal, np.einsum("knc,nc->k", self.of_points, weighted))
        left = off - np.tensordot(identity, self.of_points, 1)
        return identity, np.einsum("cmn,nc->mc", self.precision, left)

    def fitted_points(self, identity: Array, weights: Array) -> Array:
        """The posterior mean of the points, (n, 3)."""
        fitted: Array = self.points + np.tensordot(identity, self.of_points, 1) + self.smooth @ weights
        return fitted

    def surface(self, identity: Array, weights: Array) -> Array:
        """The posterior mean of the surface, (V, 3)."""
        moved = np.tensordot(identity.astype(np.float32), self.identity, 1) + self.kernel @ weights.astype(np.float32)
        surface: Array = self.mean + moved
        return surface


@lru_cache(maxsize=4)
def head_regression(model: MorphableModel, prior: Prior) -> HeadRegression:
    """For a model whose last vertices are its points ("facemesh468"). Kept for the last few priors: 15 MB each."""
    split = int(model.landmarks["facemesh468"][0])
    mean = model.mean.astype(np.float64)
    shapes = model.identity.directions[: prior.identity]
    of_points = shapes[:, split:].astype(np.float64)
    kernel = np.float32(prior.deviation**2) * _kernel(model.mean, model.mean[split:], prior.width)
    smooth = kernel[split:].astype(np.float64)
    across, depth = (
        np.linalg.inv(smooth + max(noise, 1e-3) ** 2 * np.eye(len(smooth)))
        for noise in (prior.noise, prior.depth_noise)
    )
    precision = np.stack([across, across, depth])
    weighted = np.einsum("cmn,knc->kmc", precision, of_points, optimize=True)
    normal = np.tensordot(weighted, of_points, ((1, 2), (1, 2))) + np.eye(len(shapes))
    return HeadRegression(
        mean[:split], shapes[:, :split], kernel[:split], mean[split:], of_points, smooth, precision, normal
    )


def _kernel(a: NDArray[np.float32], b: NDArray[np.float32], width: float) -> NDArray[np.float32]:
    squared = (a * a).sum(axis=1)[:, None] + (b * b).sum(axis=1) - 2 * a @ b.T
    kernel: NDArray[np.float32] = np.exp(np.minimum(squared * np.float32(-0.5 / max(width, 1e-3) ** 2), 0))
    return kernel
