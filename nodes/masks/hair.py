"""The hair detector (paper, section 2): what the pixels at the top of this photo's head look like.

Those pixels need not be hair, and those beside the head need not be backdrop: long hair fills the sides of many a
portrait. So two densities, of the top and of what is beside, are learnt in turn: a pixel of either that the other
explains better loses its say. Where both explain it alike, its place decides: deep inside of the head it is hair.
What is surely skin is a third rival, of the top. On a bald head or under nothing but backdrop little is left, and then
there is no hair.

Nothing here is decided by a threshold on one pixel: every choice is a slope, and the lead of hair is averaged over a
pixel's neighbours before it is judged. With thresholds, noise of one 8-bit level moved the hair of one photo in five by
more than 2 %.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from graphface import node
from graphface.nodes.head_shape import CHIN, EYE_LINE
from graphface.nodes.masks.exposed_skin import bare_skin
from graphface.nodes.masks.features import PixelFeatures
from graphface.nodes.masks.likeness import Likeness, Model, likeness_of
from graphface.nodes.masks.prior import BACKDROP, CLOTHES, HAIR, Layout, layout_of, log_prior
from graphface.nodes.types import FloatArray, HeadMasks, Landmarks, Mask

SHINE, SHINE_HUE = 0.07, 1.9
"""A scalp is lighter than the face by more than this share of white, and its hue off by less than this many spreads."""


SHINE_SLOPE, SHINE_HUE_SLOPE = 0.015, 0.3
"""How far from those bounds a pixel is still taken for both."""


SOFTNESS = 1.3
"""Log-likelihoods of one pixel's features are divided by this: they are not independent, and say less than they sum to.
With half as much again the hair of three portraits jumps."""


NEAR = 0.85
"""Weight of the odds that place gives hair inside of the head. With 0, hair that fills a tight crop is called backdrop:
the same color on top and beside, and more of it beside. With 1, under colored light more of a backdrop becomes
hair (path-traced heads under `red_blue`: background 0.86, with this 0.98)."""


DOUBT = 0.03
"""Pixels of anything beside those that teach hair or backdrop, in squared inter-ocular distances. Four times as much
drowned the little hair that a tight crop shows."""


SKIN_ROOM = 0.05
"""Standard deviation by which the skin's lightness is spread: a forehead shines, a neck lies in shadow."""


FADED = 1 / 6
"""Part of the least share of hair at which the response has faded to 0, by a long slope."""


LEAST_SPREAD = 0.02
"""Of the skin's hue, in feature units: that of a flat color."""


NEIGHBORHOOD = 1.0
"""Standard deviation, in working pixels, of the average that the lead of hair is judged by."""


BESIDE = 0.05
"""Distance from the head, in inter-ocular distances, from which backdrop is learnt. It takes part in proportion to how
far off it is; a backdrop learnt only far from the head would not know the shade that it has behind the hair."""


DEEP, RIM = 0.25, 0.05
"""Distance inside of the head, in inter-ocular distances, from which its top teaches hair with full weight, and the
weight at its rim. The head's solids overshoot a small skull, and the backdrop that they cover there was learnt as hair:
under side and colored light a whole backdrop became hair."""


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
    model: Model = "parzen",
    components: Annotated[int, Field(ge=1, le=16)] = 4,
    margin: Annotated[float, Field(ge=0, le=20)] = 2.0,
    least: Annotated[float, Field(ge=0, le=1)] = 0.12,
    rounds: Annotated[int, Field(ge=1, le=10)] = 3,
) -> Hair:
    """Find hair by the colors and textures on top of this head.

    Args:
        features: of the photo. masks: from the projected geometry.
        model: "parzen" densities, or the paper's "mixture" of Gaussians (see `masks.likeness`).
        components: Gaussians in each mixture.
        margin: log-likelihood by which hair must beat skin and backdrop to be learnt from in the last round; half of it
            is an even chance in the response.
        least: share of the head's top that must look like hair; the response fades, and is 0 below a sixth of it.
        rounds: times that hair and backdrop are learnt from what their rivals left.

    Returns:
        Maps of the photo's size.
    """
    import cv2

    window, values = features.window, features.values
    layout = layout_of(landmarks, window)
    unit = max(landmarks.interocular * window.scale, 1e-3)
    conservative, normal = (window.shrunk(m) for m in (masks.conservative, masks.normal))
    sure = (conservative > 0.5) & ~layout.features
    bare = bare_skin(values, sure, layout, unit)
    likeness = likeness_of(values, model, components)
    weights = skin_weights(values, sure)
    skin = likeness.log_density(weights, doubt=DOUBT * unit**2, room=SKIN_ROOM)
    covered = (1 - bare.reshape(-1)) * (1 - shiny(values, weights))
    places = Places(*_teachers(normal, layout), covered, _odds(layout))
    learnt = detector(likeness, places, skin, margin=margin, rounds=rounds, doubt=DOUBT * unit**2)
    enough = float(np.clip((learnt.share / max(least, 1e-6) - FADED) / (1 - FADED), 0, 1))
    lead = np.clip(learnt.lead.reshape(bare.shape), -30, 30)
    lead = np.asarray(cv2.GaussianBlur(lead, (0, 0), NEIGHBORHOOD), np.float32)
    against = np.minimum(places.odds, 0).reshape(bare.shape)
    found = enough * sigmoid((lead - margin / 2) / SOFTNESS + against) * (1 - bare)
    # A line along the silhouette mixes the colors of both sides, and so resembles neither; hair is wider than that.
    found = np.asarray(cv2.morphologyEx(found, cv2.MORPH_OPEN, np.ones((3, 3), np.uint8)), np.float32)
    response = window.enlarged(found, masks.normal.shape, beyond=0)
    return Hair(response, response * masks.normal)


@dataclass(frozen=True)
class Places:
    """What place and skin say about each pixel before hair is known, (n,) each.

    `top` and `beside`: how much a pixel teaches hair, or backdrop, in [0, 1]. `covered`: how surely it is no bare and
    no shining skin. `odds`: log odds of hair against backdrop.
    """

    top: FloatArray
    beside: FloatArray
    covered: FloatArray
    odds: FloatArray


@dataclass(frozen=True)
class Learnt:
    """`lead`: how far, (n,), hair beats the best of its rivals. `share` of the top that wins by the margin.

    The share is counted without softness: where neither can win, half of all pixels' small chances are no hair.
    """

    lead: FloatArray
    share: float


def detector(
    likeness: Likeness, places: Places, skin: FloatArray, *, margin: float, rounds: int, doubt: float
) -> Learnt:
    """A density of the top that neither skin nor backdrop explains, against one of the sides that hair does not.

    The margin by which hair must win grows from 0 round by round: before the two are told apart neither wins by much.

    Args:
        skin: log-likelihood of every pixel as skin. doubt: see `Likeness.log_density`.
    """
    hairy, empty = places.covered, 1 - sigmoid(np.minimum(places.odds, 0))
    inside = NEAR * np.maximum(places.odds, 0)
    for step in range(rounds + 1):
        mine = likeness.log_density(places.top * hairy, doubt=doubt)
        backdrop = likeness.log_density(places.beside * empty, doubt=doubt)
        lead = mine - np.maximum(skin, backdrop - inside)
        hairy = places.covered * sigmoid((lead - margin * step / rounds) / SOFTNESS)
        empty = 1 - sigmoid((mine - backdrop) / SOFTNESS + np.minimum(places.odds, 0))
    share = float((places.top * places.covered) @ sigmoid(lead - margin) / max(float(places.top.sum()), 1e-6))
    mine = likeness.log_density(places.top * hairy, doubt=doubt)
    return Learnt(mine - np.maximum(skin, backdrop - inside), share)


def _teachers(normal: FloatArray, layout: Layout) -> tuple[FloatArray, FloatArray]:
    """`top` and `beside` of `Places`."""
    top = (normal > 0.5) & (layout.outline > 0.05) & (layout.high > EYE_LINE + 0.15)
    beside = (normal < 0.5) & (layout.head > BESIDE) & (layout.high > CHIN)
    deep = np.clip(-layout.head / DEEP, RIM, 1)
    return (top * deep).reshape(-1).astype(np.float32), beside.reshape(-1).astype(np.float32)


def _odds(layout: Layout) -> FloatArray:
    expected = log_prior(layout)
    return (expected[..., HAIR] - np.logaddexp(expected[..., BACKDROP], expected[..., CLOTHES])).reshape(-1)


def skin_weights(values: FloatArray, where: NDArray[np.bool_]) -> FloatArray:
    """How much each pixel teaches skin, float32 (n,): those far from the median (a beard, a fringe, glasses) little."""
    colors, chosen = values[..., :3].reshape(-1, 3), where.reshape(-1)
    weights = np.zeros(len(colors), np.float32)
    if chosen.any():
        away = np.abs(colors[chosen] - np.median(colors[chosen], axis=0))
        spread = np.maximum(1.5 * np.median(away, axis=0), 0.03)
        weights[chosen] = np.exp(-0.5 * np.square(np.max(away / spread, axis=1) / 2.0))
    return weights


def shiny(values: FloatArray, skin: FloatArray) -> FloatArray:
    """How surely each pixel (n,) is lighter than the skin and nearly of its hue: a bald head's, not fair hair.

    Args:
        skin: weights (n,) of the pixels that are skin; where all are 0 nothing shines.
    """
    colors, total = values[..., :3].reshape(-1, 3), float(skin.sum())
    if total < 1e-6:
        return np.zeros(len(colors), np.float32)
    away = np.asarray(colors - skin @ colors / total, np.float32)
    chroma = np.square(away[:, 1:]).sum(axis=1)
    spread = float(np.sqrt(float(skin @ chroma) / total + 2 * LEAST_SPREAD**2))
    lighter = sigmoid((away[:, 0] - SHINE) / SHINE_SLOPE)
    alike = (SHINE_HUE - np.sqrt(chroma) / spread) / SHINE_HUE_SLOPE
    return lighter * sigmoid(np.asarray(alike, np.float32))


def sigmoid(x: FloatArray) -> FloatArray:
    return np.asarray(1 / (1 + np.exp(-np.clip(x, -60, 60))), np.float32)
