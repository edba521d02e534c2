"""The label network: a small U-Net (`graphface.nodes.unet`) that labels the pixels about a head.

Its weights come from `graphface models labels`.
"""

from __future__ import annotations

from graphface.nodes.types import FloatArray
from graphface.nodes.unet import Weights, unet

WIDTHS = (16, 32, 48, 64)
"""Channels at each level, finest first."""


def label_scores(cells: FloatArray, weights: Weights) -> FloatArray:
    """Scores (logits) of face, hair and background, float32 2h x 2w x 3.

    Args:
        cells: h x w x C from `masks.network_input`, h and w multiples of 8.
    """
    return unet(cells, weights, len(WIDTHS))
