"""Illumination as real spherical harmonics: evaluate it on normals, fit it to a shading.

Ramamoorthi and Hanrahan, An Efficient Representation for Irradiance Environment Maps, SIGGRAPH 2001: the irradiance of
distant light on a convex Lambertian surface is, to within a percent, a second-order polynomial in the normal. The paper
fits the first order (section 2, "Face illumination").
"""

from __future__ import annotations

from typing import Annotated, Any

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from graphface import node, warn
from graphface.nodes.types import FloatArray, Lighting, LightingFit, Mask, Normals, Shading

ILL_CONDITIONED = 1e3
"""Condition number above which a fit is said to rest on its ridge. A frontal face at first order has about 20."""

_CONDITION_CAP = 1e12


@node("sh.fit")
def fit(
    shading: Shading,
    normals: Normals,
    mask: Mask,
    *,
    order: Annotated[int, Field(ge=0, le=3)] = 1,
    ridge: Annotated[float, Field(ge=1e-9, le=1)] = 1e-4,
) -> LightingFit:
    """The light whose shading of these normals comes nearest to `shading` over the mask, by least squares.

    Minimizes sum_x mask(x) (shading(x) - sum_i c_i Y_i(n(x)))^2 + ridge * W * sum_{i > 0} c_i^2, in float64, where W
    is the mask's total weight. The constant term carries no ridge, so where the normals say nothing (a flat wall, one
    pixel) the answer is the mean shading as ambient light.

    Args:
        shading: H x W, or H x W x 3 for one light per channel.
        normals: H x W x 3 unit; pixels without a surface (0, 0, 0) take no part.
        mask: H x W weights, 0..1.
        order: 0 ambient, 1 as the paper (4 coefficients), 2 (9), 3 (16).
        ridge: relative weight of the ridge.

    Returns:
        `light`; `residual` shading minus fit, H x W (x 3), 0 off the mask; `condition` of the unridged system, capped
        at 1e12.
    """
    used = (mask > 0) & has_surface(normals)
    if not np.isfinite(shading).all():
        used &= np.isfinite(shading.reshape(*mask.shape, -1)).all(axis=2)
    channels = shading.shape[2:]
    if not used.any():
        warn("sh.fit: the mask holds no pixel with a normal; took the mean shading of the picture as ambient light")
        return _ambient_fit(shading, order)

    weights = mask[used].astype(np.float64)
    design = basis(normals[used].astype(np.float64), order)
    values = shading[used].astype(np.float64)
    weighted = design * weights[:, None]
    gram = weighted.T @ design
    total = max(float(weights.sum()), 1e-12)
    penalty = np.full(len(gram), ridge * total)
    penalty[0] = 1e-12 * total
    coefficients = np.linalg.solve(gram + np.diag(penalty), weighted.T @ values)

    condition = _condition(gram)
    if condition > ILL_CONDITIONED:
        warn(
            f"sh.fit: the normals under the mask barely tell directions apart (condition {condition:.3g}); "
            "the ridge decided"
        )
    light = Lighting(coefficients.astype(np.float32))
    residual = np.zeros((*mask.shape, *channels), np.float32)
    residual[used] = values - design @ coefficients
    return LightingFit(light, residual, condition)


@node("sh.render")
def render(light: Lighting, normals: Normals) -> Shading:
    """The shading of a surface under a light: sum_i c_i Y_i(n), never below 0; 0 where there is no surface.

    Returns:
        float32, H x W, or H x W x 3 for a coloured light.
    """
    covered = has_surface(normals)
    values = basis(normals[covered], light.order) @ light.coefficients
    shading = np.zeros((*covered.shape, *light.coefficients.shape[1:]), np.float32)
    shading[covered] = np.maximum(values, 0)
    return shading


def basis(normals: NDArray[np.floating[Any]], order: int) -> NDArray[np.floating[Any]]:
    """Y_lm of unit vectors (n, 3), columns in (l, m) order: (n, (order + 1)^2), in the dtype of `normals`."""
    x, y, z = normals[:, 0], normals[:, 1], normals[:, 2]
    columns = [np.full_like(x, 0.282095)]
    if order >= 1:
        columns += [0.488603 * y, 0.488603 * z, 0.488603 * x]
    if order >= 2:
        columns += [
            1.092548 * x * y,
            1.092548 * y * z,
            0.315392 * (3 * z * z - 1),
            1.092548 * x * z,
            0.546274 * (x * x - y * y),
        ]
    if order >= 3:
        columns += [
            0.590044 * y * (3 * x * x - y * y),
            2.890611 * x * y * z,
            0.457046 * y * (5 * z * z - 1),
            0.373176 * z * (5 * z * z - 3),
            0.457046 * x * (5 * z * z - 1),
            1.445306 * z * (x * x - y * y),
            0.590044 * x * (x * x - 3 * y * y),
        ]
    return np.stack(columns, axis=1)


def has_surface(normals: Normals) -> NDArray[np.bool_]:
    """Where a normal map holds a surface, H x W (several times faster than `any` over so short an axis)."""
    x, y, z = normals[..., 0], normals[..., 1], normals[..., 2]
    surface: NDArray[np.bool_] = (x != 0) | (y != 0) | (z != 0)
    return surface


def ambient(irradiance: float | FloatArray, order: int = 0) -> Lighting:
    """The light that gives every normal the same irradiance (a number, or one per channel)."""
    value = np.asarray(irradiance, np.float32)
    coefficients = np.zeros(((order + 1) ** 2, *value.shape), np.float32)
    coefficients[0] = value / 0.282095
    return Lighting(coefficients)


def _ambient_fit(shading: FloatArray, order: int) -> LightingFit:
    values = np.where(np.isfinite(shading), shading, 0)
    mean = values.mean(axis=(0, 1), dtype=np.float64) if values.size else np.zeros(shading.shape[2:])
    return LightingFit(ambient(np.asarray(mean, np.float32), order), np.zeros_like(shading), _CONDITION_CAP)


def _condition(gram: NDArray[np.float64]) -> float:
    """Condition number of the design matrix behind a Gram matrix, capped."""
    values = np.linalg.eigvalsh(gram)
    return float(
        min(np.sqrt(max(values[-1], 0) / max(values[0], values[-1] / _CONDITION_CAP**2, 1e-300)), _CONDITION_CAP)
    )
