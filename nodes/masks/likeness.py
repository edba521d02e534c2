"""How like a label each pixel looks, learnt on this photo: the swap between densities and mixtures.

Both are Gaussian mixtures. "parzen" has a Gaussian for each pixel and nothing to fit, "mixture" a few that are fitted
(the paper's classifiers). Detector and classifiers ask for no more than a log-likelihood of every pixel, given how much
each pixel teaches, and do not know which of the two they have.
"""

from __future__ import annotations

from typing import Literal, Protocol

import numpy as np
from numpy.typing import NDArray

from graphface import warn
from graphface.nodes.masks.mixture import fit_mixture, widened
from graphface.nodes.masks.parzen import Palette
from graphface.nodes.types import FloatArray

Model = Literal["parzen", "mixture"]


SAMPLES = 2000
"""Pixels that a mixture is fitted to, about."""


STEPS = 12
"""Of expectation maximization: a mixture stopped half-way moves more with the noise of the photo."""


EVIDENCE = 0.6
"""Weight of a mixture's log-likelihoods: its eleven features are not independent, and say less than they sum to."""


UNKNOWN = -1.0
"""Log-likelihood of a class of which there is no sample, beside a broad Gaussian of the whole window."""


class Likeness(Protocol):
    """Learns from weighted pixels of one photo what others look like; `anything` is the log-likelihood (n,) of every
    pixel under a broad density of all of them."""

    anything: FloatArray

    def log_density(self, weights: FloatArray, *, doubt: float = 0.0, room: float = 0.0) -> FloatArray:
        """See `masks.parzen.Palette.log_density`."""


def likeness_of(values: FloatArray, model: Model, components: int) -> Likeness:
    """The model of a photo's features h x w x D; `components` Gaussians in each mixture."""
    return Palette(values) if model == "parzen" else Mixtures(values, components)


class Mixtures:
    """A few Gaussians for each label, by expectation maximization on some of its pixels (see `masks.mixture`)."""

    def __init__(self, values: FloatArray, components: int) -> None:
        self._flat = values.reshape(-1, values.shape[-1])
        self._components = components
        broad = fit_mixture(self._flat[sampled(np.ones(len(self._flat), bool))], components=1, floor=0.1)
        if broad is None:
            warn("masks: no pixel has finite features; labels follow from their place alone")
            self.anything = np.zeros(len(self._flat), np.float32)
        else:
            self.anything = EVIDENCE * broad.log_likelihood(self._flat)

    def log_density(self, weights: FloatArray, *, doubt: float = 0.0, room: float = 0.0) -> FloatArray:
        """As of a `Palette`; a mixture needs no doubt."""
        chosen = sampled(weights > 0)
        mixture = fit_mixture(self._flat[chosen], weights[chosen], components=self._components, rounds=STEPS)
        if mixture is None:
            return np.asarray(self.anything + EVIDENCE * UNKNOWN, np.float32)
        return np.asarray(EVIDENCE * widened(mixture, room).log_likelihood(self._flat), np.float32)


def sampled(where: NDArray[np.bool_]) -> NDArray[np.intp]:
    """Flat indices of about `SAMPLES` of the chosen pixels, spread as if at random.

    Whether a pixel is taken depends on its place and hardly on what else is chosen: where noise flips one pixel in or
    out, the others stay. (Every n-th of the chosen ones would become all others from there on.)
    """
    index = np.flatnonzero(where)
    scrambled = (index.astype(np.uint64) * np.uint64(2654435761)) & np.uint64(0xFFFFFFFF)  # Knuth's multiplicative hash
    return index[scrambled < SAMPLES / max(len(index), 1) * 2.0**32]
