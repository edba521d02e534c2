"""The logarithmic domain, in which shading and reflectance add up: into it and out of it again."""

from __future__ import annotations

import numpy as np

from graphface import warn
from graphface.nodes.color import channel_mean
from graphface.nodes.types import FloatArray, Image, Intrinsic, Mask

DARKEST = 1 / 64
"""Intensity below which logarithms stop falling: four steps of an 8-bit photo, where there is only noise."""


def finite_pixels(photo: Image, operator: str) -> FloatArray:
    """The photo's pixels; holes (NaN, infinity) are filled with the mean of the others, and a warning says so."""
    pixels = photo.pixels
    if np.isfinite(pixels.sum(dtype=np.float64)):
        return pixels
    good = np.isfinite(pixels)
    mean = pixels[good].mean(dtype=np.float64) if good.any() else 0.0
    warn(f"{operator}: {int((~good).any(axis=2).sum())} pixels are not finite; filled with the mean of the others")
    return np.where(good, pixels, np.float32(mean)).astype(np.float32, copy=False)


def log_intensity(pixels: FloatArray, darkest: float = DARKEST) -> FloatArray:
    """log of the mean of R, G and B, at least `darkest`; H x W."""
    return np.log(np.maximum(channel_mean(pixels), np.float32(darkest)))


def chromaticity(pixels: FloatArray, darkest: float = DARKEST) -> FloatArray:
    """Color without brightness, (R, G, B) / (R + G + B), H x W x 3; drawn towards grey in the dark."""
    padded = np.maximum(pixels, 0) + np.float32(darkest)
    grey: FloatArray = padded / (3 * channel_mean(padded))[..., None]
    return grey


def separated(pixels: FloatArray, log_shading: FloatArray, mask: Mask | None, floor: float) -> Intrinsic:
    """Albedo and shading from the logarithm of the shading up to a constant.

    Args:
        mask: H x W, over which shading gets the mean of the intensity; everywhere where it is None or empty.
        floor: least shading that is divided by; albedo stays below (brightest pixel) / floor.

    Returns:
        albedo * shading is `pixels` to rounding.
    """
    # Subtracting the highest value first keeps exp in range whatever constant the solve left over.
    relative = np.exp(np.clip(log_shading - log_shading.max(), -12, 0))
    scale = _average(channel_mean(pixels), mask) / max(_average(relative, mask), 1e-6)
    shading = np.clip(np.float32(scale) * relative, np.float32(floor), np.float32(8)).astype(np.float32, copy=False)
    return Intrinsic(albedo=pixels / shading[..., None], shading=shading)


def _average(values: FloatArray, mask: Mask | None) -> float:
    total = 0.0 if mask is None else float(mask.sum(dtype=np.float64))
    if mask is None or not total > 1e-6:
        return float(values.mean(dtype=np.float64))
    return float((values * mask).sum(dtype=np.float64) / total)
