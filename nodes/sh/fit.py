"""The light that explains a shading: least squares over the face, plain or robust, with or without a bound at zero."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from graphface import node, warn
from graphface.nodes.color import channel_mean
from graphface.nodes.harmonics import Y_0, Y_1, ambient, basis, has_surface
from graphface.nodes.sh.nonnegative import nonnegative_coefficients
from graphface.nodes.sh.regression import CONDITION_CAP, Robust, condition_number, gram_matrix, robust_regression
from graphface.nodes.types import FloatArray, Lighting, LightingFit, Mask, Normals, Shading

ILL_CONDITIONED = 1e3
"""Condition number above which the ridge decides part of the fit, with a warning. A frontal face at first order has
about 20."""


SAMPLES = 1 << 12
"""Approximate number of pixels of a fit; of a larger face a regular grid is used. A light has few unknowns: with eight
times as many, relit heads and photographs score the same, to 0.02 dB and 0.0001, for three times the time."""


_DIRECTION_RIDGE = 1e-4


@node("sh.fit", version=3)
def fit(
    shading: Shading,
    normals: Normals,
    mask: Mask,
    *,
    order: Annotated[int, Field(ge=0, le=3)] = 1,
    ridge: Annotated[float, Field(ge=1e-9, le=1)] = 1e-4,
    robust: Robust = "trimmed",
    keep: Annotated[float, Field(ge=0.5, le=1)] = 0.8,
    nonnegative: bool = False,
    grey: bool = False,
) -> LightingFit:
    """The light l_s whose shading of the normals is nearest to `shading` over the mask (paper, equation 2).

    l_s = argmin_l sum_x m(x) (s(x) - sum_i l_i Y_i(n(x)))^2 + ridge * sum_x m(x) * sum_{i > 0} l_i^2, in float64. The
    constant term has no ridge, so where the normals determine nothing (a flat wall, one pixel) the result is ambient
    light of the mean shading.

    Args:
        shading: s, H x W, or H x W x 3 for one light per channel.
        normals: n, H x W x 3 unit; pixels without a surface (0, 0, 0) are left out.
        mask: m, H x W weights, 0..1.
        order: 0 is ambient light, 1 as in the paper (4 coefficients), 2 (9), 3 (16).
        ridge: relative weight of the ridge.
        robust: against what no light explains: brows, eyes, lips, beards, cast shadows and highlights; see
            `graphface.nodes.sh.regression`. (Relit path-traced heads: none 28.0, huber 29.0, trimmed 29.0 dB; two
            heads of another family 27.4, 27.6, 27.6 dB; squared error on the Yale set 0.0099, 0.0098, 0.0097.)
        keep: share of the pixels that "trimmed" fits.
        nonnegative: constrain the light to be at least 0 in 600 directions.
        grey: one light for all channels of a colored shading.

    Returns:
        `light`; `residual` shading minus fit, H x W (x 3), 0 off the mask; `condition` of the system without ridge, at
        most 1e12; `direction`, unit vector towards most of the light, (0, 0, 0) for even light.
    """
    used = (mask > 0) & has_surface(normals)
    if not np.isfinite(shading).all():
        used &= np.isfinite(shading.reshape(*mask.shape, -1)).all(axis=2)
    if grey:
        shading = channel_mean(shading)
    if not used.any():
        warn("sh.fit: the mask holds no pixel with a normal; took the mean shading of the picture as ambient light")
        return _ambient_fit(shading, order)

    sampled = _sampled(used)
    design, weights = basis(normals[sampled], order), mask[sampled].astype(np.float64)
    coefficients = robust_regression(design, shading[sampled], weights, ridge, robust, keep)
    gram = gram_matrix(design, weights)
    if nonnegative:
        coefficients = nonnegative_coefficients(coefficients, gram, order)
    condition = condition_number(gram)
    if condition > ILL_CONDITIONED:
        warn(
            f"sh.fit: the normals under the mask hardly differ (condition {condition:.3g}); "
            "the ridge decides part of the light"
        )
    light = Lighting(coefficients.astype(np.float32))
    residual = _residual(shading, normals, used, light)
    return LightingFit(light, residual, condition, dominant_direction(_first_order(coefficients, gram)))


def dominant_direction(light: Lighting) -> FloatArray:
    """Unit vector along the first-order part, float32 (3,), mean over channels; zeros where there is none."""
    if light.order == 0:
        return np.zeros(3, np.float32)
    y, z, x = light.coefficients.reshape(len(light.coefficients), -1).mean(axis=1)[1:4]
    vector = np.array([x, y, z], np.float64)
    length = float(np.linalg.norm(vector))
    constant = float(np.abs(light.coefficients[0]).mean())
    return (vector / length if length > 1e-6 * max(constant, 1e-6) else np.zeros(3)).astype(np.float32)


def _ambient_fit(shading: FloatArray, order: int) -> LightingFit:
    values = np.where(np.isfinite(shading), shading, 0)
    mean = values.mean(axis=(0, 1), dtype=np.float64) if values.size else np.zeros(shading.shape[2:])
    light = ambient(np.asarray(mean, np.float32), order)
    return LightingFit(light, np.zeros_like(shading), CONDITION_CAP, dominant_direction(light))


def _sampled(used: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """The used pixels on a regular grid, about `SAMPLES`; all of them where the grid would miss most of a thin face."""
    count = int(np.count_nonzero(used))
    stride = int(np.sqrt(count / SAMPLES))
    if stride < 2:
        return used
    grid = np.zeros_like(used)
    grid[::stride, ::stride] = used[::stride, ::stride]
    return grid if np.count_nonzero(grid) * stride**2 > count / 2 else used


def _residual(shading: Shading, normals: Normals, used: NDArray[np.bool_], light: Lighting) -> FloatArray:
    """Shading minus fit, 0 off `used`. The first order is affine in the normal: one pass of OpenCV."""
    if light.order > 1:
        residual = np.zeros(shading.shape, np.float32)
        residual[used] = shading[used] - basis(normals[used], light.order) @ light.coefficients
        return residual
    import cv2

    constant, *first = light.coefficients.reshape(len(light.coefficients), -1)
    y, z, x = first if first else [np.zeros_like(constant)] * 3
    affine = np.stack([Y_1 * x, Y_1 * y, Y_1 * z, Y_0 * constant], axis=1)
    fitted = np.asarray(cv2.transform(normals, affine), np.float32).reshape(shading.shape)
    residual = shading - fitted
    residual[~used] = 0
    return residual


def _first_order(coefficients: NDArray[np.float64], gram: NDArray[np.float64]) -> Lighting:
    """The first-order light nearest to a fit over the same pixels.

    On the half of the sphere that the camera sees, the first and the second order of a fit compensate each other, so
    the first-order coefficients of a higher fit alone mean little.
    """
    if len(coefficients) <= 4:
        return Lighting(coefficients.astype(np.float32))
    own = gram[:4, :4] + _DIRECTION_RIDGE * gram[0, 0] * np.eye(4)
    return Lighting(np.linalg.solve(own, gram[:4] @ coefficients).astype(np.float32))
