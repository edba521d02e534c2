"""MR8: eight texture responses, the maxima over directions of a bank of 38 filters.

Varma and Zisserman, A Statistical Approach to Texture Classification from Single Images, IJCV 2005: edges (first
derivative) and bars (second derivative) of an anisotropic Gaussian at 3 scales and 6 directions, of which the strongest
direction of each scale is kept, and an isotropic Gaussian and its Laplacian: 3 + 3 + 2 responses.
"""

from __future__ import annotations

from functools import cache
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.types import FloatArray

DIRECTIONS = 6


SCALES = ((1.0, 3.0), (2.0, 6.0), (4.0, 12.0))
"""Standard deviations across and along the filter, pixels."""


ISOTROPIC_SCALE = 10.0
"""Standard deviation of the isotropic Gaussian and of the Laplacian, pixels."""


Bank = Literal["pyramid", "full"]


def mr8(grey: FloatArray, bank: Bank = "pyramid") -> FloatArray:
    """The responses H x W x 8: edge and bar at each scale from fine to coarse, then Gaussian and Laplacian.

    Args:
        grey: float32 H x W.
        bank: "full" filters with all 38 kernels at full size; "pyramid" applies the finest kernels to pictures of half
            and quarter size for the coarser scales, about twenty times faster.
    """
    import cv2

    maps = []
    for level, sigmas in enumerate(SCALES):
        if bank == "full":
            maps += _strongest(grey, sigmas)
        else:
            size = (max(1, grey.shape[1] >> level), max(1, grey.shape[0] >> level))
            small = np.asarray(cv2.resize(grey, size, interpolation=cv2.INTER_AREA), np.float32)
            maps += [_resized(m, grey.shape) for m in _strongest(small, SCALES[0])]
    blurred, laplacian = _isotropic(grey, bank)
    return np.stack([*maps, blurred, laplacian], axis=2).astype(np.float32, copy=False)


def _strongest(grey: FloatArray, sigmas: tuple[float, float]) -> list[FloatArray]:
    """Edge and bar response, each the maximal magnitude over the directions."""
    import cv2

    found = []
    for kernels in oriented(*sigmas):
        responses = (np.abs(cv2.filter2D(grey, cv2.CV_32F, k, borderType=cv2.BORDER_REFLECT)) for k in kernels)
        strongest = next(responses)
        for response in responses:
            np.maximum(strongest, response, out=strongest)
        found.append(strongest)
    return found


def _isotropic(grey: FloatArray, bank: Bank) -> tuple[FloatArray, FloatArray]:
    """Gaussian and scale-normalized Laplacian of it, at standard deviation `ISOTROPIC_SCALE`."""
    import cv2

    level = 0 if bank == "full" else 2
    size = (max(1, grey.shape[1] >> level), max(1, grey.shape[0] >> level))
    small = cv2.resize(grey, size, interpolation=cv2.INTER_AREA)
    sigma = ISOTROPIC_SCALE / (1 << level)
    blurred = np.asarray(cv2.GaussianBlur(small, (0, 0), sigma, borderType=cv2.BORDER_REFLECT), np.float32)
    laplacian = np.asarray(sigma**2 * cv2.Laplacian(blurred, cv2.CV_32F, borderType=cv2.BORDER_REFLECT), np.float32)
    return _resized(blurred, grey.shape), _resized(laplacian, grey.shape)


def _resized(values: FloatArray, shape: tuple[int, ...]) -> FloatArray:
    import cv2

    return np.asarray(cv2.resize(values, shape[::-1], interpolation=cv2.INTER_LINEAR), np.float32)


@cache
def oriented(across: float, along: float) -> tuple[tuple[NDArray[np.float32], ...], tuple[NDArray[np.float32], ...]]:
    """Kernels of edges and of bars, one per direction, of mean 0 and absolute sum 1."""
    radius = int(np.ceil(3 * along))
    y, x = np.mgrid[-radius : radius + 1, -radius : radius + 1].astype(np.float64)
    edges, bars = [], []
    for angle in np.arange(DIRECTIONS) * np.pi / DIRECTIONS:
        u, v = x * np.cos(angle) + y * np.sin(angle), y * np.cos(angle) - x * np.sin(angle)
        gauss = np.exp(-(u**2) / (2 * across**2) - v**2 / (2 * along**2))
        edges.append(_normalized(-u / across**2 * gauss))
        bars.append(_normalized((u**2 / across**2 - 1) / across**2 * gauss))
    return tuple(edges), tuple(bars)


def _normalized(kernel: NDArray[np.float64]) -> NDArray[np.float32]:
    kernel = kernel - kernel.mean()
    return np.asarray(kernel / np.abs(kernel).sum(), np.float32)
