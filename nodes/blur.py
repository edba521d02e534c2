"""Gaussian blur: exact, or at a cost that does not grow with its width; and averages of weighted pixels."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from graphface.nodes.types import FloatArray

_LEAST_SIGMA = 3.0
"""Pixels. A wider Gaussian is computed on a smaller copy of the picture, in which it is this wide."""


def blurred(values: FloatArray, sigma: float) -> FloatArray:
    """A map under a Gaussian of standard deviation `sigma` pixels; beyond the border the outermost pixel repeats.

    A wide Gaussian is computed on a smaller copy. On noise the result differs from the exact one by at most 0.01 of the
    amplitude, along the border by 0.2, where the exact blur repeats a single pixel and this one a mean of pixels. A
    blur of 50 pixels is a hundred times faster.

    Args:
        values: float32 H x W or H x W x c.
        sigma: above 0.

    Returns:
        float32 of the same shape.

    >>> step = np.zeros((1, 400), np.float32)
    >>> step[:, 200:] = 1
    >>> blurred(step, 20.0)[0, [0, 199, 220, 399]].round(2)  # one sigma beyond the step: 0.84
    array([0.  , 0.49, 0.85, 1.  ], dtype=float32)
    """
    import cv2

    height, width = values.shape[:2]
    factor = min(sigma / _LEAST_SIGMA, height, width)
    if factor < 1.5:
        return np.asarray(cv2.GaussianBlur(values, (0, 0), sigma, borderType=cv2.BORDER_REPLICATE), np.float32)
    size = max(1, round(width / factor)), max(1, round(height / factor))
    small = cv2.resize(values, size, interpolation=cv2.INTER_AREA)
    small = cv2.GaussianBlur(small, (0, 0), sigma * size[0] / width, borderType=cv2.BORDER_REPLICATE)
    return np.asarray(cv2.resize(small, (width, height), interpolation=cv2.INTER_LINEAR), np.float32)


def gaussian(values: FloatArray, sigma: float) -> FloatArray:
    """A map under the exact Gaussian of standard deviation `sigma` pixels, at least 0.5; the border repeats.

    For small pictures: the cost grows with `sigma`.

    Args:
        values: float32 H x W or H x W x c.

    Returns:
        float32 of the same shape.

    >>> spot = np.zeros((9, 9), np.float32)
    >>> spot[4, 4] = 1
    >>> gaussian(spot, 1.0)[4, 4:7].round(2)  # 1 / (2 pi) in the middle
    array([0.16, 0.1 , 0.02], dtype=float32)
    """
    import cv2

    return np.asarray(cv2.GaussianBlur(values, (0, 0), max(sigma, 0.5), borderType=cv2.BORDER_REPLICATE), np.float32)


def normalized(
    values: FloatArray,
    weight: FloatArray,
    sigma: float,
    least: float,
    blur: Callable[[FloatArray, float], FloatArray] = gaussian,
) -> FloatArray:
    """Gaussian averages over weighted pixels alone (normalized convolution, Knutsson and Westin 1993).

    Args:
        values: float32 H x W or H x W x c. weight: H x W, 0 or more.
        sigma: standard deviation, pixels, above 0.
        least: the smallest sum of weights under the Gaussian that is divided by; far from all of them the result is 0.
        blur: `gaussian`, or `blurred` for large pictures.

    Returns:
        float32 of the shape of `values`.

    >>> row = np.float32([[0, 0, 1, 1]])
    >>> normalized(row, np.float32([[0, 0, 1, 1]]), 1.0, 1e-3)[0, 1]
    np.float32(1.0)
    """
    deep = values if values.ndim == 3 else values[..., None]
    sums = blur(np.concatenate([deep * weight[..., None], weight[..., None]], axis=2), sigma)
    average = sums[..., :-1] / np.maximum(sums[..., -1:], np.float32(least))
    return np.asarray(average.reshape(values.shape), np.float32)
