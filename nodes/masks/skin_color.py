"""The color of this face's skin: which pixels show it, and which show its highlights."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.masks.logits import sigmoid
from graphface.nodes.types import FloatArray

HIGHLIGHT_LIGHTNESS, HIGHLIGHT_LIGHTNESS_SLOPE = 0.07, 0.015
"""A highlight is lighter than the skin by this share of white; and the width of the soft threshold."""


HIGHLIGHT_HUE, HIGHLIGHT_HUE_SLOPE = 1.9, 0.3
"""A highlight's chroma differs from the skin's by at most this many standard deviations; and the width of the soft
threshold."""


MIN_HUE_SPREAD = 0.02
"""Least standard deviation of the skin's chroma, in feature units: that of a flat color."""


def skin_weights(values: FloatArray, skin: NDArray[np.bool_]) -> FloatArray:
    """Weight of each pixel as a sample of skin, float32 (n,).

    Colors far from the median (a beard, a fringe, glasses) weigh little.

    Args:
        values: features h x w x D, color first. skin: h x w, the pixels to use.
    """
    colors, chosen = values[..., :3].reshape(-1, 3), skin.reshape(-1)
    weights = np.zeros(len(colors), np.float32)
    if chosen.any():
        away = np.abs(colors[chosen] - np.median(colors[chosen], axis=0))
        spread = np.maximum(1.5 * np.median(away, axis=0), 0.03)
        weights[chosen] = np.exp(-0.5 * np.square(np.max(away / spread, axis=1) / 2.0))
    return weights


def highlights(values: FloatArray, weights: FloatArray) -> FloatArray:
    """How surely each pixel (n,) is a highlight on skin: lighter than the skin and nearly of its hue.

    A bald scalp has such highlights. Fair hair has another hue.

    Args:
        values: features h x w x D, color first.
        weights: (n,) of the pixels as samples of skin; where all are 0 there are no highlights.
    """
    colors, total = values[..., :3].reshape(-1, 3), float(weights.sum())
    if total < 1e-6:
        return np.zeros(len(colors), np.float32)
    away = np.asarray(colors - weights @ colors / total, np.float32)
    chroma = np.square(away[:, 1:]).sum(axis=1)
    spread = float(np.sqrt(float(weights @ chroma) / total + 2 * MIN_HUE_SPREAD**2))
    lighter = sigmoid((away[:, 0] - HIGHLIGHT_LIGHTNESS) / HIGHLIGHT_LIGHTNESS_SLOPE)
    same_hue = (HIGHLIGHT_HUE - np.sqrt(chroma) / spread) / HIGHLIGHT_HUE_SLOPE
    return lighter * sigmoid(np.asarray(same_hue, np.float32))
