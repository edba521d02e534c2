"""The hair detector (paper, section 2): a Gaussian mixture of the pixels at the top of this photo's head.

Those pixels need not be hair, and those beside the head need not be backdrop: long hair fills the sides of many a
portrait. So two mixtures, of the top and of what is beside, are fitted in turn: a pixel of either that the other
explains better loses its say. What is surely skin is a third rival, of the top. On a bald head or under nothing but
backdrop little is left, and then there is no hair.

Nothing here is decided by a threshold on one pixel or one Gaussian: every choice is a slope, and the lead of hair is
averaged over a pixel's neighbours before it is judged. With thresholds, noise of one 8-bit level moved the hair of one
photo in five by more than 2 %.
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
from graphface.nodes.masks.prior import BACKDROP, CLOTHES, HAIR, layout_of, log_prior, log_sum_exp
from graphface.nodes.types import FloatArray, HeadMasks, Landmarks, Mask

SAMPLES = 2000
"""Pixels that a mixture is fitted to, about."""

SHINE, SHINE_HUE = 0.07, 1.9
"""A scalp is lighter than the face by more than this share of white, and its hue off by less than this many spreads."""

SHINE_SLOPE, SHINE_HUE_SLOPE = 0.015, 0.3
"""How far from those bounds a Gaussian is still taken for both."""

SOFTNESS = 2.0
"""Log-likelihoods of one pixel's features are divided by this: they are not independent, and say less than they sum to.
Twice as much lost the hair of a path-traced head altogether."""

NEIGHBORHOOD = 1.0
"""Standard deviation, in working pixels, of the average that the lead of hair is judged by."""

BESIDE = 0.05
"""Distance from the head, in inter-ocular distances, from which backdrop is learnt. It takes part in proportion to how
far off it is; a backdrop learnt only far from the head would not know the shade that it has behind the hair."""

DEEP, RIM = 0.25, 0.05
"""Distance inside of the head, in inter-ocular distances, from which its top teaches hair with full weight, and the
weight at its rim. The head's solids overshoot a small skull, and the backdrop that they cover there was learnt as hair:
under side and coloured light a whole backdrop became hair (path-traced heads under `left45`: background 0.974, with
this 0.980; under `red_blue`: hair 0.78, with this 0.89)."""


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
        margin: log-likelihood by which hair must beat skin and backdrop to be learnt from in the last round; half of it
            is an even chance in the response.
        least: share of the head's top that must look like hair; the response fades, and is 0 below half of it.
        rounds: times that hair and backdrop are fitted to what their rivals left.

    Returns:
        Maps of the photo's size.
    """
    import cv2

    window, values = features.window, features.values
    flat = values.reshape(-1, values.shape[2])
    layout = layout_of(landmarks, window)
    conservative, normal = (window.shrunk(m) for m in (masks.conservative, masks.normal))
    shape = masks.normal.shape
    sure = (conservative > 0.5) & ~layout.features
    bare = bare_skin(values, sure, layout, landmarks.interocular * window.scale)
    skin = skin_mixture(values, sure, components)
    top = sampled((normal > 0.5) & (layout.outline > 0.05) & (layout.high > EYE_LINE + 0.15))
    beside = sampled((normal < 0.5) & (layout.head > BESIDE) & (layout.high > CHIN))
    expected = log_prior(layout)
    far = np.minimum(expected[..., HAIR] - np.logaddexp(expected[..., BACKDROP], expected[..., CLOTHES]), 0)
    deep = np.clip(-layout.head / DEEP, RIM, 1).reshape(-1)
    heads = Samples(flat[top], 1 - bare.reshape(-1)[top], deep[top])
    sides = Samples(flat[beside], far.reshape(-1)[beside], np.ones(len(beside), np.float32))
    learnt = detector(heads, sides, skin, components=components, margin=margin, rounds=rounds)
    enough = 0.0 if learnt is None else float(np.clip(2 * learnt.share / max(least, 1e-6) - 1, 0, 1))
    if learnt is None or enough == 0:
        nothing = np.zeros(shape, np.float32)
        return Hair(nothing, nothing)
    rivals = [m for m in (skin, learnt.backdrop) if m is not None]
    lead = (learnt.hair.log_likelihood(flat) - rival_likelihood(flat, rivals)).reshape(values.shape[:2])
    lead = np.asarray(cv2.GaussianBlur(np.clip(lead, -30, 30), (0, 0), NEIGHBORHOOD), np.float32)
    found = enough * sigmoid((lead - margin / 2) / SOFTNESS + far) * (1 - bare)
    # A line along the silhouette mixes the colours of both sides, and so resembles neither; hair is wider than that.
    found = np.asarray(cv2.morphologyEx(found, cv2.MORPH_OPEN, np.ones((3, 3), np.uint8)), np.float32)
    response = window.enlarged(found, shape, beyond=0)
    return Hair(response, response * masks.normal)


@dataclass(frozen=True)
class Samples:
    """Features `values` (n, D); `prior` (n,): of the top how surely no bare skin, of the sides the log odds of hair;
    `weight` (n,): how much each says, in (0, 1]."""

    values: FloatArray
    prior: FloatArray
    weight: FloatArray


@dataclass(frozen=True)
class Learnt:
    """Mixtures of hair and of what is beside the head, and the `share` of the top that wins by the margin.

    The share is counted without softness: where neither can win, half of all pixels' small chances are no hair.
    """

    hair: Mixture
    backdrop: Mixture | None
    share: float


def detector(
    top: Samples, beside: Samples, skin: Mixture | None, *, components: int, margin: float, rounds: int
) -> Learnt | None:
    """A mixture of the top that neither skin nor backdrop explains, and one of the sides that hair does not.

    The margin by which hair must win grows from 0 round by round: before the two are told apart neither wins by much.
    None where nothing is left of the top.
    """
    hairy, empty = top.prior, 1 - sigmoid(beside.prior)
    mixture, backdrop = _fitted(top, hairy, components), _fitted(beside, empty, components)
    for step in range(rounds + 1):
        if mixture is None:
            return None
        joint = mixture.joint(top.values)
        total = log_sum_exp(joint)
        rivals = [m for m in (skin, backdrop) if m is not None]
        lead = total[:, 0] - rival_likelihood(top.values, rivals)
        covered = top.prior if skin is None else top.prior * (1 - np.exp(joint - total) @ shiny(mixture, skin))
        hairy = covered * sigmoid((lead - margin * step / rounds) / SOFTNESS)
        if step == rounds:
            break
        if backdrop is not None:
            lost = mixture.log_likelihood(beside.values) - backdrop.log_likelihood(beside.values)
            empty = 1 - sigmoid(lost / SOFTNESS + beside.prior)
        mixture, backdrop = _fitted(top, hairy, components), _fitted(beside, empty, components)
    mixture = _fitted(top, hairy, components)
    if mixture is None:
        return None
    return Learnt(mixture, backdrop, float(np.average(covered * sigmoid(lead - margin), weights=top.weight)))


def _fitted(samples: Samples, chances: FloatArray, components: int) -> Mixture | None:
    return fit_mixture(samples.values, samples.weight * chances, components=components)


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


def shiny(mixture: Mixture, skin: Mixture) -> FloatArray:
    """How surely each Gaussian (K,) is lighter than the skin and nearly of its hue: a bald head's, not fair hair."""
    middle = skin.weights @ skin.means
    between = np.square(skin.means - middle)[:, 1:3]
    spread = np.sqrt((skin.weights @ (between + np.diagonal(skin.covariances, axis1=1, axis2=2)[:, 1:3])).sum())
    away = mixture.means - middle
    hue = np.hypot(away[:, 1], away[:, 2]) / max(float(spread), 1e-6)
    bounds = ((away[:, 0] - SHINE) / SHINE_SLOPE, (SHINE_HUE - hue) / SHINE_HUE_SLOPE)
    lighter, alike = (sigmoid(bound.astype(np.float32)) for bound in bounds)
    return np.asarray(lighter * alike, np.float32)


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
