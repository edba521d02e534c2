"""The logarithmic domain, in which shading and reflectance add up: into it and back."""

from __future__ import annotations

import numpy as np

from graphface import warn
from graphface.nodes.color import channel_mean
from graphface.nodes.types import FloatArray, Image, Intrinsic, Mask

DARKEST = 1 / 64
"""Least intensity of which a logarithm is taken: four steps of an 8-bit photo, below which there is only noise."""


_LOG_RANGE = 12.0
"""Largest difference of log shading within a picture."""


_BRIGHTEST_SHADING = 8.0


def finite_pixels(photo: Image, operator: str) -> FloatArray:
    """The photo's pixels; those that are not finite are replaced by the mean of the others, with a warning."""
    pixels = photo.pixels
    if np.isfinite(pixels.sum(dtype=np.float64)):
        return pixels
    finite = np.isfinite(pixels)
    mean = pixels[finite].mean(dtype=np.float64) if finite.any() else 0.0
    warn(f"{operator}: {int((~finite).any(axis=2).sum())} pixels are not finite; filled with the mean of the others")
    return np.where(finite, pixels, np.float32(mean)).astype(np.float32, copy=False)


def log_intensity(pixels: FloatArray, darkest: float = DARKEST) -> FloatArray:
    """log(max((R + G + B) / 3, darkest)), float32 H x W."""
    return np.log(np.maximum(channel_mean(pixels), np.float32(darkest)))


def chromaticity(pixels: FloatArray, darkest: float = DARKEST) -> FloatArray:
    """(R, G, B) / (R + G + B), float32 H x W x 3; `darkest` is added to each channel, so black is grey.

    >>> chromaticity(np.float32([[[0.5, 0.5, 0.5], [0, 0, 0]]])).round(3)
    array([[[0.333, 0.333, 0.333],
            [0.333, 0.333, 0.333]]], dtype=float32)
    """
    padded = np.maximum(pixels, 0) + np.float32(darkest)
    chroma: FloatArray = padded / (3 * channel_mean(padded))[..., None]
    return chroma


def intrinsic_images(pixels: FloatArray, log_shading: FloatArray, mask: Mask | None, floor: float) -> Intrinsic:
    """Albedo and shading from the logarithm of the shading, which is given up to a constant.

    Args:
        mask: H x W; over it shading gets the mean of the intensity. None or an empty mask: over the whole picture.
        floor: least shading that is divided by; albedo stays below (brightest pixel) / floor.

    Returns:
        albedo * shading is `pixels` to rounding.
    """
    # With the largest value subtracted first, exp stays in range whatever the constant is.
    relative = np.exp(np.clip(log_shading - log_shading.max(), -_LOG_RANGE, 0))
    scale = _mean(channel_mean(pixels), mask) / max(_mean(relative, mask), 1e-6)
    shading = np.clip(np.float32(scale) * relative, np.float32(floor), np.float32(_BRIGHTEST_SHADING))
    shading = shading.astype(np.float32, copy=False)
    return Intrinsic(albedo=pixels / shading[..., None], shading=shading)


def _mean(values: FloatArray, mask: Mask | None) -> float:
    total = 0.0 if mask is None else float(mask.sum(dtype=np.float64))
    if mask is None or not total > 1e-6:
        return float(values.mean(dtype=np.float64))
    return float((values * mask).sum(dtype=np.float64) / total)
