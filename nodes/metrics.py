"""How near one result is to another."""

from __future__ import annotations

import numpy as np

from graphface.nodes.types import FloatArray, Mask, Normals

_LEAST_ERROR = 1e-12
"""Mean squared error that stands for none: 120 dB."""


def psnr(result: FloatArray, truth: FloatArray, mask: Mask | None = None) -> float:
    """Peak signal-to-noise ratio in dB for values in [0, 1], weighted by the mask (H x W); at most 120."""
    return _decibel(_mean(np.square(result.astype(np.float64) - truth), mask))


def si_psnr(result: FloatArray, truth: FloatArray, mask: Mask | None = None) -> float:
    """PSNR after the one gain on `result` that serves it best: what remains is not a matter of exposure."""
    wide = result.astype(np.float64)
    gain = _mean(wide * truth, mask) / max(_mean(wide * wide, mask), _LEAST_ERROR)
    return _decibel(_mean(np.square(gain * wide - truth), mask))


def mean_angle(normals: Normals, truth: Normals, mask: Mask | None = None) -> float:
    """Mean angle between two normal maps in degrees, over the pixels where both have a surface.

    Raises:
        ValueError: there is no such pixel.
    """
    both = np.any(normals != 0, axis=2) & np.any(truth != 0, axis=2)
    weights = both if mask is None else both * mask
    if not weights.any():
        raise ValueError("the two normal maps have no pixel in common")
    a, b = normals.astype(np.float64), truth.astype(np.float64)
    lengths = np.linalg.norm(a, axis=2) * np.linalg.norm(b, axis=2)
    cosine = np.einsum("hwc,hwc->hw", a, b) / np.maximum(lengths, _LEAST_ERROR)
    return float(np.average(np.degrees(np.arccos(np.clip(cosine, -1, 1))), weights=weights))


def _mean(values: np.ndarray[tuple[int, ...], np.dtype[np.float64]], mask: Mask | None) -> float:
    if mask is None:
        return float(values.mean())
    of_pixel = values.mean(axis=2) if values.ndim == 3 else values
    return float((of_pixel * mask).sum() / max(float(mask.sum(dtype=np.float64)), _LEAST_ERROR))


def _decibel(error: float) -> float:
    return float(-10 * np.log10(max(error, _LEAST_ERROR)))
