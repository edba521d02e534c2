"""The hair detector (paper, section 2): a Gaussian mixture of the pixels at the top of this photo's head.

Those pixels need not be hair. So the mixture has rivals, fitted to what is surely skin and surely background: a pixel
that a rival explains about as well loses its say, and the mixture is fitted again. On a bald head or under nothing but
backdrop little is left, and then there is no hair.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from graphface import node
from graphface.nodes.masks.bare import bare_skin
from graphface.nodes.masks.features import PixelFeatures
from graphface.nodes.masks.head import CHIN, EYE_LINE
from graphface.nodes.masks.mixture import Mixture, fit_mixture
from graphface.nodes.masks.prior import layout_of, log_sum_exp
from graphface.nodes.types import FloatArray, HeadMasks, Landmarks, Mask

SAMPLES = 2000
"""Pixels that a mixture is fitted to, about."""

SHINE, SHINE_HUE = 0.07, 1.9
"""A scalp is lighter than the face by more than this share of white, and its hue off by less than this many spreads."""


@dataclass(frozen=True)
class Hair:
    """`response`: how much each pixel looks like this head's hair, 0..1; `mask`: that within the normal face mask."""

    response: Mask
    mask: Mask


@node("masks.hair")
def hair(
    features: PixelFeatures,
    masks: HeadMasks,
    landmarks: Landmarks,
    *,
    components: Annotated[int, Field(ge=1, le=16)] = 4,
    margin: Annotated[float, Field(ge=0, le=20)] = 3.0,
    least: Annotated[float, Field(ge=0, le=1)] = 0.12,
    rounds: Annotated[int, Field(ge=1, le=10)] = 3,
) -> Hair:
    """Find hair by the colours and textures on top of this head.

    Args:
        features: of the photo. masks: from the projected geometry.
        components: Gaussians in each mixture.
        margin: log-likelihood by which hair must beat skin and background.
        least: where less than this share of the head's top looks like hair, there is none.
        rounds: times the mixture is fitted to what its rivals left.

    Returns:
        Maps of the photo's size.
    """
    import cv2

    window, values = features.window, features.values
    flat = values.reshape(-1, values.shape[2])
    layout = layout_of(landmarks, window)
    conservative, normal, aggressive = (window.shrunk(m) for m in (masks.conservative, masks.normal, masks.aggressive))
    shape = masks.normal.shape
    top = (normal > 0.5) & (layout.outline > 0.05) & (layout.high > EYE_LINE + 0.15)
    sure = (conservative > 0.5) & ~layout.features
    bare = bare_skin(values, sure, layout, landmarks.interocular * window.scale)
    skin = skin_mixture(values, sure, components)
    beside = fit_mixture(flat[sampled((aggressive < 0.5) & (layout.high > CHIN))], components=components)
    rivals = [m for m in (skin, beside) if m is not None]
    chosen = sampled(top)
    mixture = detector(flat[chosen], 1 - bare.reshape(-1)[chosen], skin, rivals, components, margin, least, rounds)
    if mixture is None:
        nothing = np.zeros(shape, np.float32)
        return Hair(nothing, nothing)
    lead = mixture.log_likelihood(flat) - rival_likelihood(flat, rivals)
    found = sigmoid(lead - margin).reshape(values.shape[:2]) * (1 - bare)
    # A line along the silhouette mixes the colours of both sides, and so resembles neither; hair is wider than that.
    found = np.asarray(cv2.morphologyEx(found, cv2.MORPH_OPEN, np.ones((3, 3), np.uint8)), np.float32)
    response = window.enlarged(found, shape, beyond=0)
    return Hair(response, response * masks.normal)


def detector(
    samples: FloatArray,
    covered: FloatArray,
    skin: Mixture | None,
    rivals: list[Mixture],
    components: int,
    margin: float,
    least: float,
    rounds: int,
) -> Mixture | None:
    """A mixture of the samples (n, D) that neither a rival nor shining skin explains; None where too few are left.

    `covered` (n,) is how surely each sample is no bare skin.
    """
    rival = rival_likelihood(samples, rivals)
    mixture = fit_mixture(samples, covered, components=components)
    for _ in range(rounds):
        if mixture is None:
            return None
        joint = mixture.joint(samples)
        total = log_sum_exp(joint)
        weights = covered * sigmoid(total[:, 0] - rival - margin)
        if skin is not None:
            weights *= 1 - np.exp(joint - total)[:, shiny(mixture, skin)].sum(axis=1)
        if weights.mean() < least:
            return None
        mixture = fit_mixture(samples, weights, components=components)
    return mixture


def skin_mixture(values: FloatArray, where: NDArray[np.bool_], components: int) -> Mixture | None:
    """A mixture of the skin's pixels: those far from their median (a beard, a fringe, glasses) weigh little.

    Lightness, the first feature, gets more room: a forehead shines, a neck lies in shadow.
    """
    samples = values.reshape(-1, values.shape[2])[sampled(where)]
    if not len(samples):
        return None
    colors = samples[:, :3]
    middle = np.median(colors, axis=0)
    away = np.abs(colors - middle)
    spread = np.maximum(1.5 * np.median(away, axis=0), 0.03)
    weights = np.exp(-0.5 * np.square(np.max(away / spread, axis=1) / 2.0))
    mixture = fit_mixture(samples, weights, components=components)
    if mixture is None:
        return None
    widened = mixture.covariances.copy()
    widened[:, 0, 0] += 0.06**2
    return Mixture(mixture.weights, mixture.means, widened)


def shiny(mixture: Mixture, skin: Mixture) -> NDArray[np.bool_]:
    """Which Gaussians of a mixture are lighter than the skin and nearly of its hue: a bald head's, not fair hair."""
    middle = skin.weights @ skin.means
    between = np.square(skin.means - middle)[:, 1:3]
    spread = np.sqrt((skin.weights @ (between + np.diagonal(skin.covariances, axis1=1, axis2=2)[:, 1:3])).sum())
    away = mixture.means - middle
    hue = np.hypot(away[:, 1], away[:, 2]) / max(float(spread), 1e-6)
    lighter: NDArray[np.bool_] = (away[:, 0] > SHINE) & (hue < SHINE_HUE)
    return lighter


def rival_likelihood(samples: FloatArray, rivals: list[Mixture]) -> FloatArray:
    """The best log-likelihood that any rival gives each sample; very low where there are no rivals."""
    best = np.full(len(samples), -1e3, np.float32)
    for mixture in rivals:
        np.maximum(best, mixture.log_likelihood(samples), out=best)
    return best


def sampled(where: NDArray[np.bool_]) -> NDArray[np.intp]:
    """Flat indices of about `SAMPLES` of the chosen pixels, spread as if at random.

    Whether a pixel is taken depends on its place and hardly on what else is chosen: where noise flips one pixel in or
    out, the others stay. (Every n-th of the chosen ones would become all others from there on.)
    """
    index = np.flatnonzero(where)
    scrambled = (index.astype(np.uint64) * np.uint64(2654435761)) & np.uint64(0xFFFFFFFF)  # Knuth's multiplicative hash
    return index[scrambled < SAMPLES / max(len(index), 1) * 2.0**32]


def sigmoid(x: FloatArray) -> FloatArray:
    return np.asarray(1 / (1 + np.exp(-np.clip(x, -60, 60))), np.float32)
