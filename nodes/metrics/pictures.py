"""How near one picture or map is to another; arrays H x W or H x W x 3, weighted by a mask H x W."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.types import FloatArray, Mask

Wide = NDArray[np.float64]


_LEAST_ERROR = 1e-12
"""Mean squared error that stands for none: 120 dB."""


_SCALE_WEIGHTS = (0.0448, 0.2856, 0.3001, 0.2363, 0.1333)


_SSIM_REACH = 11


def psnr(result: FloatArray, truth: FloatArray, mask: Mask | None = None) -> float:
    """Peak signal-to-noise ratio in dB for values in [0, 1], weighted by the mask (H x W); at most 120."""
    return _decibel(_mean(np.square(result.astype(np.float64) - truth), mask))


def si_psnr(result: FloatArray, truth: FloatArray, mask: Mask | None = None) -> float:
    """PSNR after the one gain on `result` that serves it best: what remains is not a matter of exposure."""
    wide = result.astype(np.float64)
    gain = _mean(wide * truth, mask) / max(_mean(wide * wide, mask), _LEAST_ERROR)
    return _decibel(_mean(np.square(gain * wide - truth), mask))


def si_mse(result: FloatArray, truth: FloatArray, mask: Mask | None = None) -> float:
    """Mean squared error after the best gain, over the mean square of the truth: 0 is the truth, 1 as bad as black."""
    wide, target = result.astype(np.float64), truth.astype(np.float64)
    gain = _mean(wide * target, mask) / max(_mean(wide * wide, mask), _LEAST_ERROR)
    return _mean(np.square(gain * wide - target), mask) / max(_mean(target * target, mask), _LEAST_ERROR)


def lmse(result: FloatArray, truth: FloatArray, mask: Mask | None = None, *, window: int = 20) -> float:
    """Local mean squared error: `si_mse` with a gain of its own in every half-overlapping window, summed.

    Grosse, Johnson, Adelson, Freeman, Ground Truth Dataset and Baseline Evaluations for Intrinsic Image Algorithms,
    ICCV 2009. It looks past slow errors of shading and sees misplaced edges.

    Args:
        window: pixels to a side, 20 in the paper.
    """
    wide, target = (_channels(x) for x in (result, truth))
    weight = np.ones(wide.shape[:2]) if mask is None else mask.astype(np.float64)
    error = total = 0.0
    step = max(1, window // 2)
    for top in range(0, max(1, wide.shape[0] - step), step):
        for left in range(0, max(1, wide.shape[1] - step), step):
            part = np.s_[top : top + window, left : left + window]
            w, one, other = weight[part][..., None], wide[part], target[part]
            gain = (w * one * other).sum() / max((w * one * one).sum(), _LEAST_ERROR)
            error += float((w * np.square(gain * one - other)).sum())
            total += float((w * np.square(other)).sum())
    return error / max(total, _LEAST_ERROR)


def ssim(result: FloatArray, truth: FloatArray, mask: Mask | None = None) -> float:
    """Structural similarity (Wang et al., TIP 2004) of values in [0, 1], mean over the mask; 1 is the truth."""
    return _ssim_terms(_channels(result), _channels(truth), mask)[0]


def ms_ssim(result: FloatArray, truth: FloatArray, mask: Mask | None = None) -> float:
    """Multi-scale structural similarity (Wang, Simoncelli, Bovik 2003): five scales, fewer for small pictures."""
    import cv2

    one, other, weight = _channels(result), _channels(truth), mask
    product, used = 1.0, 0.0
    for level, power in enumerate(_SCALE_WEIGHTS):
        whole, contrast = _ssim_terms(one, other, weight)
        last = level == len(_SCALE_WEIGHTS) - 1 or min(one.shape[:2]) < 2 * _SSIM_REACH
        product *= max(whole if last else contrast, 0.0) ** power
        used += power
        if last:
            break
        size = (one.shape[1] // 2, one.shape[0] // 2)
        one, other = (_channels(cv2.resize(x, size, interpolation=cv2.INTER_AREA)) for x in (one, other))
        weight = None if weight is None else np.asarray(cv2.resize(weight, size, interpolation=cv2.INTER_AREA))
    return float(product ** (1 / used))


def _ssim_terms(one: Wide, other: Wide, mask: Mask | None) -> tuple[float, float]:
    """Mean similarity, and mean of its contrast and structure term alone."""
    import cv2

    def blurred(x: Wide) -> Wide:
        return _channels(cv2.GaussianBlur(x, (0, 0), 1.5, borderType=cv2.BORDER_REFLECT))

    mean, mean_other = blurred(one), blurred(other)
    spread = np.maximum(blurred(one * one) - mean * mean, 0) + np.maximum(
        blurred(other * other) - mean_other * mean_other, 0
    )
    contrast = (2 * (blurred(one * other) - mean * mean_other) + 0.03**2) / (spread + 0.03**2)
    luminance = (2 * mean * mean_other + 0.01**2) / (mean * mean + mean_other * mean_other + 0.01**2)
    return _mean(luminance * contrast, mask), _mean(contrast, mask)


def _channels(values: NDArray[Any]) -> Wide:
    """H x W x c in float64."""
    wide = np.asarray(values, np.float64)
    return wide[..., None] if wide.ndim == 2 else wide


def _mean(values: np.ndarray[tuple[int, ...], np.dtype[np.float64]], mask: Mask | None) -> float:
    if mask is None:
        return float(values.mean())
    of_pixel = values.mean(axis=2) if values.ndim == 3 else values
    return float((of_pixel * mask).sum() / max(float(mask.sum(dtype=np.float64)), _LEAST_ERROR))


def _decibel(error: float) -> float:
    return float(-10 * np.log10(max(error, _LEAST_ERROR)))
