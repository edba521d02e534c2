"""The hair detector (paper, section 2): pixels that look like the top of this photo's head.

Nothing here is decided by a threshold on one pixel: every decision is a ramp, and the log-likelihood ratio of hair is
averaged over a pixel's neighbors first. With thresholds, noise of one 8-bit level changed the hair of one photo in five
by more than 2 %.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import Formerly, node
from graphface.nodes.masks.density import Model, density_model
from graphface.nodes.masks.exposed_skin import exposed_skin
from graphface.nodes.masks.features import PixelFeatures
from graphface.nodes.masks.hair_detector import TEMPERATURE, detect_hair, evidence_of
from graphface.nodes.masks.layout import layout_of
from graphface.nodes.masks.logits import sigmoid
from graphface.nodes.masks.skin_color import highlights, skin_weights
from graphface.nodes.types import HeadMasks, Landmarks, Mask

PSEUDO_COUNT = 0.03
"""Pseudo-count of the densities of hair and backdrop, in squared inter-ocular distances. Four times as much drowned the
little hair that a tight crop shows."""


SKIN_LIGHTNESS_SPREAD = 0.05
"""Standard deviation by which the skin's lightness is spread: a forehead has highlights, a neck lies in shadow."""


FADED = 1 / 6
"""Fraction of the least share of hair at which the response has faded to 0."""


NEIGHBORHOOD = 1.0
"""Standard deviation, in working pixels, of the Gaussian that averages the log-likelihood ratio."""


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
    min_share: Annotated[float, Field(ge=0, le=1), Formerly("least")] = 0.12,
    rounds: Annotated[int, Field(ge=1, le=10)] = 3,
) -> Hair:
    """Hair by the colors and textures on top of this head.

    Args:
        features: of the photo. masks: from the projected geometry.
        model: "parzen" (kernel density), or the paper's "mixture" of Gaussians (see `masks.density`).
        components: Gaussians in each mixture.
        margin: log-likelihood ratio by which hair must win over skin and backdrop in the last round of learning; at
            half of it the response is 1/2.
        min_share: share of the head's top that must look like hair. Below it the response fades; it is 0 at a sixth.
        rounds: in which hair and backdrop are learned from each other's rest.

    Returns:
        Maps of the photo's size.
    """
    import cv2

    window, values = features.window, features.values
    layout = layout_of(landmarks, window)
    unit = max(landmarks.interocular * window.scale, 1e-3)
    conservative, normal = (window.downsampled(m) for m in (masks.conservative, masks.normal))
    sure_skin = (conservative > 0.5) & ~layout.features
    exposed = exposed_skin(values, sure_skin, layout, unit)
    density = density_model(values, model, components)
    weights, pseudo_count = skin_weights(values, sure_skin), PSEUDO_COUNT * unit**2
    skin = density.log_density(weights, pseudo_count=pseudo_count, lightness_spread=SKIN_LIGHTNESS_SPREAD)
    not_skin = (1 - exposed.reshape(-1)) * (1 - highlights(values, weights))
    evidence = evidence_of(normal, layout, not_skin)
    found = detect_hair(density, evidence, skin, margin=margin, rounds=rounds, pseudo_count=pseudo_count)
    fading = float(np.clip((found.share / max(min_share, 1e-6) - FADED) / (1 - FADED), 0, 1))
    log_ratio = np.clip(found.log_ratio.reshape(exposed.shape), -30, 30)
    log_ratio = np.asarray(cv2.GaussianBlur(log_ratio, (0, 0), NEIGHBORHOOD), np.float32)
    outside = evidence.outside.reshape(exposed.shape)
    response = fading * sigmoid((log_ratio - margin / 2) / TEMPERATURE + outside) * (1 - exposed)
    # A line along the silhouette mixes the colors of both sides and resembles neither. Hair is wider than that.
    response = np.asarray(cv2.morphologyEx(response, cv2.MORPH_OPEN, np.ones((3, 3), np.uint8)), np.float32)
    response = window.upsampled(response, masks.normal.shape, outside=0)
    return Hair(response, response * masks.normal)
