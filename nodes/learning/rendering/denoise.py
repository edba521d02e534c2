"""The noise of few paths removed by what is known about the scene.

Radiance over albedo varies with the normal and with the lamp's shadow, and is nearly linear in them in a small window:
a guided filter (He, Sun, Tang, Guided Image Filtering, ECCV 2010) with these as guide keeps every edge that they have.
Eight paths a pixel then look like some hundred.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.types import FloatArray, Normals

_RADIUS, _EPSILON = 2, 1e-4
"""Of the filter's window, pixels; its regularization, in squares of the guide's unit."""

_SHEEN = 0.06
"""Added to the albedo: reflection at the surface does not take its color."""

_FIREFLY = 4.0
"""Values above so many times the median of their neighbors are those of a single path."""


def denoised(
    radiance: FloatArray,
    albedo: FloatArray,
    normals: Normals,
    visibility: NDArray[np.uint8],
    covered: NDArray[np.bool_],
) -> FloatArray:
    """Radiance H x W x 3 without noise; the background is blurred.

    Args:
        albedo: H x W x 3, linear. visibility: 255 times the lamp's visible share. covered: where the head is.
    """
    import cv2

    light = radiance / (albedo + np.float32(_SHEEN))
    median = np.stack([cv2.medianBlur(np.ascontiguousarray(light[..., k]), 5) for k in range(3)], axis=2)
    light = np.minimum(light, _FIREFLY * median + 1e-3)
    guide = np.stack([normals[..., 0], normals[..., 1], visibility.astype(np.float32) / 255], axis=2)
    smooth = cv2.ximgproc.guidedFilter(guide, np.ascontiguousarray(light, np.float32), _RADIUS, _EPSILON)
    inside = cv2.erode(covered.astype(np.uint8), np.ones((3, 3), np.uint8)).astype(np.float32)
    head = np.where(inside[..., None] > 0, smooth, light) * (albedo + np.float32(_SHEEN))
    behind = 1 - covered.astype(np.float32)
    shares = np.maximum(cv2.GaussianBlur(behind, (0, 0), 2.5), 1e-3)[..., None]
    blurred = cv2.GaussianBlur(radiance * behind[..., None], (0, 0), 2.5) / shares
    return np.asarray(np.where(covered[..., None], np.maximum(head, 0), blurred), np.float32)
