"""Which part of two reliefs is exchanged."""

from __future__ import annotations

from typing import Literal

import numpy as np

from graphface.nodes.blur import blurred
from graphface.nodes.smoothstep import smoothstep
from graphface.nodes.types import FloatArray

Which = Literal["all", "deeper", "smoother", "spots"]

_LEAST_ENERGY = np.float32(1e-6)

_EQUAL, _RAMP = 0.1, 0.4
"""Of the normalized difference of energies: where one counts as more, and the width of the ramp from there."""

_ROUND = 0.35
"""Curvature across over curvature along, from which on a dark place is a spot and not a line."""


def chosen(which: Which, own: FloatArray, other: FloatArray, width: float) -> tuple[FloatArray, FloatArray]:
    """What is taken from the photo's band and what is given of the reference's.

    Args:
        own: H x W x 3 or 4. other: H x W x 1 or 3.
        width: sigma of the neighborhood in which strength is compared, in pixels.
    """
    if which == "all":
        return own, other
    if which == "spots":
        return np.zeros_like(own), np.minimum(other, 0) * _spots(other.mean(axis=2), width / 4)[..., None]
    of_own, of_other = (blurred(np.square(band.mean(axis=2)), max(width, 0.5)) for band in (own, other))
    more = (of_other - of_own) / (of_other + of_own + _LEAST_ENERGY)
    if which == "smoother":
        more = -more
    share = smoothstep(np.asarray((more + np.float32(_EQUAL)) / np.float32(_RAMP), np.float32))[..., None]
    return own * share, other * share


def _spots(band: FloatArray, sigma: float) -> FloatArray:
    """1 where a dark place is round, 0 along a line, H x W: the ratio of the curvatures of a smoothed band."""
    import cv2

    smooth = blurred(band, max(sigma, 0.5))
    xx, yy, xy = (cv2.Sobel(smooth, -1, *order, ksize=3) for order in ((2, 0), (0, 2), (1, 1)))
    mean, apart = (xx + yy) / 2, np.sqrt(np.square(xx - yy) / 4 + np.square(xy))
    roundness = (mean - apart) / np.maximum(mean + apart, 1e-6)
    return smoothstep(np.asarray(roundness / np.float32(_ROUND), np.float32))
