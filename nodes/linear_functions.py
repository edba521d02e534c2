"""Local linear functions of color: the guided filter's coefficients.

He, Sun and Tang, Guided Image Filtering, 2010. Within every small window a map is a linear function of the picture's
color. Found on a small copy and applied to the colors of the large picture (He and Sun, Fast Guided Filter, 2015), such
functions follow the large picture's edges.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.types import FloatArray

_PAIRS = ((0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2))
"""Upper triangle of a symmetric 3 x 3 matrix."""

_LEAST_DETERMINANT = 1e-30
"""Is divided by."""


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

    >>> guide = np.random.default_rng(0).random((8, 8, 1), np.float32).repeat(3, axis=2)
    >>> slope = linear_functions(guide, 2 * guide[..., :1], 3, 1e-6)[4, 4, :3]
    >>> bool(abs(slope.sum() - 2) < 1e-2)
    True
    """
    import cv2

    def mean(values: FloatArray) -> FloatArray:
        return np.asarray(cv2.blur(values, (side, side), borderType=cv2.BORDER_REFLECT), np.float32)

    colors, values = _planes(guide), _planes(maps)
    means = [mean(color) for color in colors]
    covariance = {(i, j): mean(colors[i] * colors[j]) - means[i] * means[j] for i, j in _PAIRS}
    for i in range(3):
        covariance[i, i] += np.float32(ridge)
    inverse = _inverse(covariance)
    found = []
    for value in values:
        average = mean(value)
        crossed = [mean(color * value) - own * average for color, own in zip(colors, means, strict=True)]
        for i in range(3):
            # In float64: of a grey picture three large products cancel.
            total = sum(inverse[min(i, j), max(i, j)] * crossed[j] for j in range(3))
            slope = np.asarray(total, np.float32)
            average -= slope * means[i]
            found.append(mean(slope))
        found.append(mean(average))
    return np.stack(found, axis=2)


def _planes(values: FloatArray) -> list[FloatArray]:
    return [np.ascontiguousarray(values[..., c], np.float32) for c in range(values.shape[2])]


def _inverse(matrix: dict[tuple[int, int], FloatArray]) -> dict[tuple[int, int], NDArray[np.float64]]:
    """Of a symmetric positive definite 3 x 3 matrix at every pixel, by cofactors; both by their upper triangles.

    In float64: with a small ridge the determinant is a difference of nearly equal products.
    """
    m = {place: plane.astype(np.float64) for place, plane in matrix.items()}
    cofactors = {
        (0, 0): m[1, 1] * m[2, 2] - m[1, 2] * m[1, 2],
        (0, 1): m[0, 2] * m[1, 2] - m[0, 1] * m[2, 2],
        (0, 2): m[0, 1] * m[1, 2] - m[0, 2] * m[1, 1],
        (1, 1): m[0, 0] * m[2, 2] - m[0, 2] * m[0, 2],
        (1, 2): m[0, 1] * m[0, 2] - m[0, 0] * m[1, 2],
        (2, 2): m[0, 0] * m[1, 1] - m[0, 1] * m[0, 1],
    }
    determinant = m[0, 0] * cofactors[0, 0] + m[0, 1] * cofactors[0, 1] + m[0, 2] * cofactors[0, 2]
    reciprocal = 1 / np.maximum(determinant, _LEAST_DETERMINANT)
    return {place: cofactor * reciprocal for place, cofactor in cofactors.items()}
