"""What the figures of pictures and maps share: two arrays of one size and encoding, and means over a mask."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.color import decode_srgb, encode_srgb
from graphface.nodes.types import Albedo, FloatArray, Image, Mask, Shading

Comparable = Image | Albedo | Shading
"""A picture, or a map float32 H x W or H x W x 3."""


LEAST_ERROR = 1e-12
"""Mean squared error below which there is none: 120 dB."""


def comparable_arrays(result: Comparable, truth: Comparable) -> tuple[FloatArray, FloatArray]:
    """Both as arrays; a picture in another encoding than the truth is converted to the truth's.

    Raises:
        ValueError: their sizes differ.
    """
    if isinstance(result, Image) and isinstance(truth, Image) and result.encoding != truth.encoding:
        result = (encode_srgb if truth.encoding == "srgb" else decode_srgb)(result.pixels)
    one, other = (value.pixels if isinstance(value, Image) else value for value in (result, truth))
    if one.shape != other.shape:
        raise ValueError(f"the result is {one.shape} and the truth {other.shape}; figures need one size")
    return one, other


def with_channel_axis(values: NDArray[Any]) -> NDArray[np.float64]:
    """H x W x c in float64."""
    wide = np.asarray(values, np.float64)
    return wide[..., None] if wide.ndim == 2 else wide


def masked_mean(values: NDArray[np.float64], mask: Mask | None) -> float:
    """Mean over pixels and channels, pixels weighted by the mask (H x W)."""
    if mask is None:
        return float(values.mean())
    of_pixel = values.mean(axis=2) if values.ndim == 3 else values
    return float((of_pixel * mask).sum() / max(float(mask.sum(dtype=np.float64)), LEAST_ERROR))


def decibels(error: float) -> float:
    """-10 log10 of a mean squared error of values in [0, 1]; at most 120.

    >>> decibels(0.01)
    20.0
    """
    return float(-10 * np.log10(max(error, LEAST_ERROR)))
