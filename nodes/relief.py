"""Relief of skin: what is narrower than a fold, in the logarithm of intensity, in three bands.

A ratio is the same on dark and on pale skin. Relief is measured from a median and not from a Gaussian: a median passes
straight across what is narrow, and follows the edge of a cast shadow or of a painted pattern, which a Gaussian would
leave behind as a bright line beside a dark one.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from graphface.nodes.blur import blurred, gaussian
from graphface.nodes.face_scale import FaceScale
from graphface.nodes.types import FloatArray, Mask

FLOOR = np.float32(0.05)
"""Added to intensities before the logarithm: contrast in the dark is noise."""

WIDTHS = {"pores": 0.01, "lines": 0.03, "folds": 0.07}
"""Upper ends of the bands, in inter-ocular distances: sigmas of Gaussians, and half the side of the base's median."""

USUAL = {"pores": 0.05, "lines": 0.045, "folds": 0.045}
"""Root mean square that four of five faces stay below (58 portraits, eyes more than 140 pixels apart). What has more is
noise, a hard light or a picture that was sharpened."""

_BASE_SMOOTHING = 0.012
"""Inter-ocular distances; smooths the steps that the median is computed in."""

_SPREADS = (0.04, 0.15, 0.6, 2.4)
"""Sigmas of the averages that holes are filled by, in inter-ocular distances, the narrowest that reaches first."""

_LEVELS = 255

_NARROWEST = 0.3
"""Sigma in pixels; a narrower Gaussian is a single pixel."""


@dataclass(frozen=True)
class Relief:
    """The bands, float32 H x W x c each; they sum to the difference from the base, and are 0 off the skin."""

    pores: FloatArray
    lines: FloatArray
    folds: FloatArray


def logarithm(pixels: FloatArray) -> FloatArray:
    """Of intensities or colors, which are taken as 0 where they are negative."""
    return np.asarray(np.log(np.maximum(pixels, 0) + FLOOR), np.float32)


def relief(values: FloatArray, skin: Mask, copy: FaceScale) -> Relief:
    """The relief of a picture's logarithm.

    Args:
        values: H x W x c. skin: H x W, 0..1; what else there is (hair, eyes) has no relief, and does not change that of
            the skin beside it.
        copy: of `face_scale`; the base is computed on it.
    """
    weight, unit = copy.down(skin), copy.interocular
    small = filled(_deep(copy.down(values)), weight, unit)
    share = skin[..., None]
    difference = np.asarray((values - _deep(copy.up(base(small, weight, unit)))) * share, np.float32)
    without_pores, broad = (
        _average(difference, skin, WIDTHS[band] * unit / copy.scale) * share for band in ("pores", "lines")
    )
    return Relief(difference - without_pores, without_pores - broad, broad)


def base(values: FloatArray, weight: Mask, unit: float) -> FloatArray:
    """The median around each pixel of H x W x c; `weight` says which pixels give the range that has 255 steps."""
    import cv2

    inside = values[weight > 0.5]
    if not len(inside):
        return values
    low, high = np.quantile(inside, (0.002, 0.998))
    scale = np.float32(_LEVELS / max(float(high - low), 1e-3))
    steps = np.asarray(np.clip(np.rint((values - np.float32(low)) * scale), 0, _LEVELS), np.uint8)
    side = 2 * max(1, round(WIDTHS["folds"] * unit)) + 1
    median = _deep(np.asarray(cv2.medianBlur(steps, side), np.float32)) / scale + np.float32(low)
    return _deep(gaussian(median, _BASE_SMOOTHING * unit))


def filled(values: FloatArray, weight: Mask, unit: float) -> FloatArray:
    """H x W x c with averages of what is near in place of what has no weight (H x W, 0..1)."""
    known = values * weight[..., None]
    mean = known.sum(axis=(0, 1)) / max(float(weight.sum()), 1e-3)
    result, left = known, 1 - weight
    for width in _SPREADS:
        sums, near = (_deep(blurred(v, max(width * unit, 0.5))) for v in (known, weight))
        near = near[..., 0]
        share = left * np.clip(4 * near, 0, 1)
        result = result + (share / np.maximum(near, 1e-4))[..., None] * sums
        left = left - share
    return np.asarray(result + left[..., None] * mean, np.float32)


def _average(values: FloatArray, weight: Mask, sigma: float) -> FloatArray:
    """A Gaussian average over the weighted pixels of values that are 0 where the weight is."""
    if sigma < _NARROWEST:
        return values
    sums, near = (_deep(blurred(v, sigma)) for v in (values, weight))
    return np.asarray(sums / np.maximum(near, np.float32(1e-2)), np.float32)


def _deep(values: FloatArray) -> FloatArray:
    """With an axis for the channels, which OpenCV drops where there is one."""
    return values if values.ndim == 3 else values[..., None]
