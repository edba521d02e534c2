"""Hair against backdrop and skin: two densities learned in turn, each from the pixels that the other cannot explain.

The pixels on top of the head need not be hair, and those beside the head need not be backdrop: in many portraits long
hair fills both sides. So a density of the top and a density of the sides are learned in rounds. A pixel of either that
the other density explains better loses its weight. Where both explain it equally well, its place decides: deep inside
the head it is hair. Surely visible skin is a third density, which competes for the top. On a bald head, or where only
backdrop is on top, little weight is left, and then there is no hair.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from graphface.nodes.head_shape import CHIN, EYE_LINE
from graphface.nodes.masks.density import DensityModel
from graphface.nodes.masks.layout import Layout
from graphface.nodes.masks.logits import sigmoid
from graphface.nodes.masks.prior import BACKDROP, CLOTHES, HAIR, log_prior
from graphface.nodes.types import FloatArray

TEMPERATURE = 1.3
"""Log-likelihood ratios are divided by this: the features of one pixel are not independent, so their product is
overconfident. With half as much again the hair of three portraits jumps."""


INSIDE_WEIGHT = 0.85
"""Weight of the prior odds of hair inside the head. At 0, hair that fills a tight crop is called backdrop: the same
color is on top and beside, and more of it is beside. At 1, under colored light more of a backdrop becomes hair
(path-traced heads under `red_blue`: background 0.86, at this value 0.98)."""


MIN_DISTANCE = 0.05
"""Distance from the head, in inter-ocular distances, from which pixels are samples of backdrop. A backdrop learned only
far from the head would lack the shadow behind the hair."""


DEPTH, RIM_WEIGHT = 0.25, 0.05
"""Depth inside the head, in inter-ocular distances, from which a pixel on top has full weight as a sample of hair, and
the weight at the head's rim. The solids of `head_shape` extend beyond a small skull. The backdrop there would be
learned as hair: under side light and colored light a whole backdrop became hair."""


@dataclass(frozen=True)
class Evidence:
    """What is known of each pixel before hair is learned, float32 (n,) each.

    `top`, `beside`: weights in [0, 1] as samples of hair and of backdrop. `not_skin`: probability that it is neither
    exposed skin nor a highlight. `log_odds`: prior log odds of hair against background.
    """

    top: FloatArray
    beside: FloatArray
    not_skin: FloatArray
    log_odds: FloatArray

    @property
    def inside(self) -> FloatArray:
        """Log odds in favor of hair, at least 0."""
        return np.maximum(self.log_odds, 0)

    @property
    def outside(self) -> FloatArray:
        """Log odds against hair, at most 0."""
        return np.minimum(self.log_odds, 0)


@dataclass(frozen=True)
class Detection:
    """`log_ratio` (n,): log-likelihood of hair minus that of its best competitor. `share` of the top that is hair.

    The share is counted without temperature: where no density wins, small probabilities of many pixels are not hair.
    """

    log_ratio: FloatArray
    share: float


def evidence_of(normal: FloatArray, layout: Layout, not_skin: FloatArray) -> Evidence:
    """The evidence of geometry; `normal` is the mask of face and head, h x w."""
    top = (normal > 0.5) & (layout.outline > 0.05) & (layout.up > EYE_LINE + 0.15)
    beside = (normal < 0.5) & (layout.head > MIN_DISTANCE) & (layout.up > CHIN)
    depth = np.clip(-layout.head / DEPTH, RIM_WEIGHT, 1)
    prior = log_prior(layout)
    log_odds = prior[..., HAIR] - np.logaddexp(prior[..., BACKDROP], prior[..., CLOTHES])
    return Evidence(
        top=(top * depth).reshape(-1).astype(np.float32),
        beside=beside.reshape(-1).astype(np.float32),
        not_skin=not_skin,
        log_odds=log_odds.reshape(-1),
    )


def detect_hair(
    density: DensityModel, evidence: Evidence, skin: FloatArray, *, margin: float, rounds: int, pseudo_count: float
) -> Detection:
    """A density of the top that neither skin nor backdrop explains, against one of the sides that hair does not.

    Args:
        skin: log-likelihood of every pixel as skin, (n,).
        margin: by which hair must win in the last round. It grows linearly from 0: in early rounds the two densities
            are still alike, and neither wins by much.
        rounds: of learning.
        pseudo_count: see `DensityModel.log_density`.
    """
    top, beside, not_skin = evidence.top, evidence.beside, evidence.not_skin
    is_hair, is_backdrop = not_skin, 1 - sigmoid(evidence.outside)
    bonus = INSIDE_WEIGHT * evidence.inside
    for step in range(rounds + 1):
        hair = density.log_density(top * is_hair, pseudo_count=pseudo_count)
        backdrop = density.log_density(beside * is_backdrop, pseudo_count=pseudo_count)
        log_ratio = hair - np.maximum(skin, backdrop - bonus)
        is_hair = not_skin * sigmoid((log_ratio - margin * step / rounds) / TEMPERATURE)
        is_backdrop = 1 - sigmoid((hair - backdrop) / TEMPERATURE + evidence.outside)
    share = float((top * not_skin) @ sigmoid(log_ratio - margin) / max(float(top.sum()), 1e-6))
    hair = density.log_density(top * is_hair, pseudo_count=pseudo_count)
    return Detection(hair - np.maximum(skin, backdrop - bonus), share)
