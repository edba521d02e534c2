"""Local linear functions of color: the guided filter's coefficients.

He, Sun and Tang, Guided Image Filtering, 2010. Within every small window a map is a linear function of the picture's
color. Found on a small copy and applied to the colors of the large picture (He and Sun, Fast Guided Filter, 2015), such
functions follow the large picture's edges.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.types import FloatArray


def linear_functions(guide: FloatArray, maps: FloatArray, side: int, ridge: float) -> FloatArray:
    """a and b of value = a . color + b, for each of the maps.

    Each window's a = (covariance of colors + ridge)^-1 (covariance of colors and values) and b = mean value - a . mean
    color (equations 5 and 6); a pixel's are the means over the windows it lies in.

    Args:
        guide: h x w x 3. maps: h x w x m.
        side: of the windows, pixels, odd.
        ridge: epsilon, a variance of color; less varied windows are smoothed.

    Returns:
        float32 h x w x 4m: a's three numbers and b of the first map, then of the next.

    >>> guide = np.zeros((6, 6, 3), np.float32)
    >>> guide[:, 3:] = 1
    >>> slope = linear_functions(guide, 2 * guide[..., :1], 3, 1e-6)[2, 2, :3]
    >>> bool(abs(slope.sum() - 2) < 1e-2)
    True
    """
    count = maps.shape[2]
    mean_guide, mean_values = _boxed(guide, side), _boxed(maps, side)
    products = _boxed((guide[..., :, None] * guide[..., None, :]).reshape(*guide.shape[:2], 9), side)
    covariance = products.reshape(*guide.shape[:2], 3, 3) - mean_guide[..., :, None] * mean_guide[..., None, :]
    covariance += ridge * np.eye(3, dtype=np.float32)
    crossed = _boxed((guide[..., :, None] * maps[..., None, :]).reshape(*guide.shape[:2], 3 * count), side)
    crossed = crossed.reshape(*guide.shape[:2], 3, count) - mean_guide[..., :, None] * mean_values[..., None, :]
    slopes = _solved(covariance, crossed)
    offsets = mean_values - np.einsum("hwcl,hwc->hwl", slopes, mean_guide)
    coefficients = np.concatenate([np.moveaxis(slopes, 3, 2), offsets[..., None]], axis=3)
    return _boxed(coefficients.reshape(*guide.shape[:2], 4 * count), side)


def _solved(matrices: FloatArray, right: FloatArray) -> FloatArray:
    """Solutions of a symmetric positive definite 3 x 3 system at every pixel, by cofactors in float64."""
    m = np.moveaxis(matrices.astype(np.float64), (2, 3), (0, 1))
    cofactors = np.empty_like(m)
    for i in range(3):
        for j in range(3):
            (a, b), (c, d) = [((i + 1) % 3, (i + 2) % 3), ((j + 1) % 3, (j + 2) % 3)]
            cofactors[i, j] = m[a, c] * m[b, d] - m[a, d] * m[b, c]
    determinant = (m[0] * cofactors[0]).sum(axis=0)
    solved: NDArray[np.float64] = np.einsum("jihw,hwjl->hwil", cofactors, right)
    return np.asarray(solved / np.maximum(determinant, 1e-30)[..., None, None], np.float32)


def _boxed(values: FloatArray, side: int) -> FloatArray:
    """Means over square windows; OpenCV filters at most four channels at a time."""
    import cv2

    planes = [
        cv2.blur(np.ascontiguousarray(values[..., k : k + 4]), (side, side), borderType=cv2.BORDER_REFLECT)
        for k in range(0, values.shape[2], 4)
    ]
    return np.concatenate([p.reshape(*values.shape[:2], -1) for p in planes], axis=2)
