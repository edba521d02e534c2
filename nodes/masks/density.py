"""The density of a label's features on this photo: kernel density or a Gaussian mixture, with one interface.

Both are sums of Gaussians. "parzen" (a kernel density) has one Gaussian for each pixel and nothing to fit; "mixture"
fits a few (the paper's classifiers). The hair detector and the classifiers need only the log-likelihood of every pixel,
given the weight of each pixel as a training sample, and do not depend on which of the two they use.
"""

from __future__ import annotations

from typing import Literal, Protocol

import numpy as np
from numpy.typing import NDArray

from graphface import warn
from graphface.nodes.masks.kernel_density import KernelDensity
from graphface.nodes.masks.mixture import fit_mixture, with_lightness_spread
from graphface.nodes.types import FloatArray

Model = Literal["parzen", "mixture"]


SAMPLES = 2000
"""About this many pixels are used to fit a mixture."""


STEPS = 12
"""Steps of expectation maximization. A mixture that was stopped early changes more with the noise of the photo."""


TEMPERING = 0.6
"""Factor on a mixture's log-likelihoods: its eleven features are not independent, so the product of their likelihoods
is overconfident."""


NO_SAMPLES = -1.0
"""Log-likelihood of a class without samples, relative to the marginal density."""


class DensityModel(Protocol):
    """Densities of the features of one photo; each is learned from weighted pixels.

    `log_marginal` (n,) is the log-likelihood of every pixel under a broad density of all pixels of the photo.
    """

    log_marginal: FloatArray

    def log_density(
        self, weights: FloatArray, *, pseudo_count: float = 0.0, lightness_spread: float = 0.0
    ) -> FloatArray:
        """See `masks.kernel_density.KernelDensity.log_density`."""


def density_model(values: FloatArray, model: Model, components: int) -> DensityModel:
    """The model of a photo's features h x w x D; `components` Gaussians in each mixture."""
    return KernelDensity(values) if model == "parzen" else MixtureDensity(values, components)


class MixtureDensity:
    """A few Gaussians for each label, fitted to some of its pixels by expectation maximization (see `masks.mixture`).

    Args:
        values: features h x w x D.
        components: Gaussians in each mixture.
    """

    def __init__(self, values: FloatArray, components: int) -> None:
        self._flat = values.reshape(-1, values.shape[-1])
        self._components = components
        marginal = fit_mixture(self._flat[sampled(np.ones(len(self._flat), bool))], components=1, floor=0.1)
        if marginal is None:
            warn("masks: no pixel has finite features; labels follow from their place alone")
            self.log_marginal: FloatArray = np.zeros(len(self._flat), np.float32)
        else:
            self.log_marginal = TEMPERING * marginal.log_likelihood(self._flat)

    def log_density(
        self, weights: FloatArray, *, pseudo_count: float = 0.0, lightness_spread: float = 0.0
    ) -> FloatArray:
        """As `KernelDensity.log_density`, without the pseudo-count, which a mixture does not need."""
        chosen = sampled(weights > 0)
        mixture = fit_mixture(self._flat[chosen], weights[chosen], components=self._components, rounds=STEPS)
        if mixture is None:
            return np.asarray(self.log_marginal + TEMPERING * NO_SAMPLES, np.float32)
        spread = with_lightness_spread(mixture, lightness_spread)
        return np.asarray(TEMPERING * spread.log_likelihood(self._flat), np.float32)


def sampled(where: NDArray[np.bool_]) -> NDArray[np.intp]:
    """Flat indices of about `SAMPLES` of the chosen pixels, in a pseudo-random pattern.

    Whether a pixel is taken depends on its own index and only slightly on the number of chosen pixels: when noise adds
    or removes one pixel, the others stay. (Taking every n-th chosen pixel would change all that follow.)
    """
    index = np.flatnonzero(where)
    hashed = (index.astype(np.uint64) * np.uint64(2654435761)) & np.uint64(0xFFFFFFFF)  # Knuth's multiplicative hash
    return index[hashed < SAMPLES / max(len(index), 1) * 2.0**32]
