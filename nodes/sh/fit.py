"""The light behind a shading: least squares over the face, plain or robust, with or without the bound at zero."""

from __future__ import annotations

from typing import Annotated, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from graphface import node, warn
from graphface.nodes.color import channel_mean
from graphface.nodes.harmonics import ambient, basis, has_surface
from graphface.nodes.sh.bounded import nonnegative_coefficients
from graphface.nodes.types import FloatArray, Lighting, LightingFit, Mask, Normals, Shading

ILL_CONDITIONED = 1e3
"""Condition number above which a fit is said to rest on its ridge. A frontal face at first order has about 20."""


SAMPLES = 1 << 15
"""Pixels that a fit looks at, about; more are taken at even strides. Light has a handful of unknowns: on path-traced
heads the coefficients move by less than 0.1 %."""


Robust = Literal["none", "huber", "trimmed"]


_CONDITION_CAP = 1e12


_ROUNDS = 12


_HUBER = 1.345
"""Huber's constant in standard deviations: 95 % as efficient as least squares where there are no outliers."""


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
        robust: against what no light explains: brows, eyes, lips, beards, cast shadows and highlights. "huber" counts
            large misfits by their size instead of its square; "trimmed" fits the share `keep` that fits best (least
            trimmed squares); "none" fits all. (Relit path-traced heads: none 26.7, huber 27.5, trimmed 27.8 dB;
            squared error on every third person of the Yale set 0.0115, 0.0113, 0.0110.)
        nonnegative: no direction may receive negative light; by quadratic programming at 600 directions.
        grey: one light for all channels of a colored shading.

    Returns:
        `light`; `residual` shading minus fit, H x W (x 3), 0 off the mask; `condition` of the unridged system, capped
        at 1e12; `direction`, unit vector to where most light comes from, (0, 0, 0) where it comes evenly.
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
    design, values = basis(normals[sampled], order), shading[sampled]
    weights = mask[sampled].astype(np.float64)
    gram = _gram(design, weights)
    coefficients = _solve(design, values, weights, ridge, gram)
    if robust != "none":
        coefficients = _reweighted(design, values, weights, ridge, robust, keep, coefficients)
    if nonnegative:
        coefficients = nonnegative_coefficients(coefficients, gram, order)

    condition = _condition(gram)
    if condition > ILL_CONDITIONED:
        warn(
            f"sh.fit: the normals under the mask barely tell directions apart (condition {condition:.3g}); "
            "the ridge decided"
        )
    light = Lighting(coefficients.astype(np.float32))
    residual = _residual(shading, normals, used, light)
    return LightingFit(light, residual, condition, dominant_direction(_first_order(coefficients, gram)))


def _first_order(coefficients: NDArray[np.float64], gram: NDArray[np.float64]) -> Lighting:
    """The first-order light nearest to a fit over its own pixels: half a sphere of normals cannot tell the first order
    of a higher fit from its second, only their sum."""
    if len(coefficients) <= 4:
        return Lighting(coefficients.astype(np.float32))
    own = gram[:4, :4] + 1e-4 * gram[0, 0] * np.eye(4)
    return Lighting(np.linalg.solve(own, gram[:4] @ coefficients).astype(np.float32))


def dominant_direction(light: Lighting) -> FloatArray:
    """Unit vector along the first-order part, float32 (3,), mean over channels; zeros where there is none."""
    if light.order == 0:
        return np.zeros(3, np.float32)
    up, towards, right = light.coefficients.reshape(len(light.coefficients), -1).mean(axis=1)[1:4]
    vector = np.array([right, up, towards], np.float64)
    length = float(np.linalg.norm(vector))
    constant = float(np.abs(light.coefficients[0]).mean())
    return (vector / length if length > 1e-6 * max(constant, 1e-6) else np.zeros(3)).astype(np.float32)


def _sampled(used: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """The pixels used, or an even grid of them where there are many; all where the grid would miss most of a sliver."""
    count = int(np.count_nonzero(used))
    stride = int(np.sqrt(count / SAMPLES))
    if stride < 2:
        return used
    grid = np.zeros_like(used)
    grid[::stride, ::stride] = used[::stride, ::stride]
    return grid if np.count_nonzero(grid) * stride**2 > count / 2 else used


def _residual(shading: Shading, normals: Normals, used: NDArray[np.bool_], light: Lighting) -> FloatArray:
    """Shading minus fit, 0 off `used`. The first order is affine in the normal, which OpenCV does in one pass."""
    if light.order > 1:
        residual = np.zeros(shading.shape, np.float32)
        residual[used] = shading[used] - basis(normals[used], light.order) @ light.coefficients
        return residual
    import cv2

    constant, *first = light.coefficients.reshape(len(light.coefficients), -1)
    up, towards, right = first if first else [np.zeros_like(constant)] * 3
    affine = np.stack([0.488603 * right, 0.488603 * up, 0.488603 * towards, 0.282095 * constant], axis=1)
    fitted = np.asarray(cv2.transform(normals, affine), np.float32).reshape(shading.shape)
    left = shading - fitted
    left[~used] = 0
    return left


def _gram(design: FloatArray, weights: NDArray[np.float64]) -> NDArray[np.float64]:
    weighted = design * weights[:, None]
    gram: NDArray[np.float64] = weighted.T @ design.astype(np.float64)
    return gram


def _solve(
    design: FloatArray,
    values: FloatArray,
    weights: NDArray[np.float64],
    ridge: float,
    gram: NDArray[np.float64] | None = None,
) -> NDArray[np.float64]:
    """Ridge regression, (n,) or (n, channels)."""
    gram = _gram(design, weights) if gram is None else gram
    weighted = design * weights[:, None]
    total = max(float(weights.sum()), 1e-12)
    penalty = np.full(len(gram), ridge * total)
    penalty[0] = 1e-12 * total
    return np.asarray(np.linalg.solve(gram + np.diag(penalty), weighted.T @ values), np.float64)


def _reweighted(
    design: FloatArray,
    values: FloatArray,
    weights: NDArray[np.float64],
    ridge: float,
    robust: Robust,
    keep: float,
    coefficients: NDArray[np.float64],
) -> NDArray[np.float64]:
    """Iterate: misfits give weights, weights give the next fit. A pixel's channels are weighted together."""
    for _ in range(_ROUNDS):
        misfit = np.abs(np.asarray(values - design @ coefficients, np.float64))
        misfit = misfit.max(axis=1) if misfit.ndim == 2 else misfit
        if robust == "huber":
            limit = max(_HUBER * 1.4826 * float(np.median(misfit)), 1e-6)
            trust = np.minimum(1, limit / np.maximum(misfit, limit))
        else:
            trust = (misfit <= np.quantile(misfit, keep)).astype(np.float64)
        if not float((weights * trust).sum()) > 1e-12:
            break
        before, coefficients = coefficients, _solve(design, values, weights * trust, ridge)
        if np.abs(coefficients - before).max() <= 1e-6 * (1 + np.abs(before).max()):
            break
    return coefficients


def _ambient_fit(shading: FloatArray, order: int) -> LightingFit:
    values = np.where(np.isfinite(shading), shading, 0)
    mean = values.mean(axis=(0, 1), dtype=np.float64) if values.size else np.zeros(shading.shape[2:])
    light = ambient(np.asarray(mean, np.float32), order)
    return LightingFit(light, np.zeros_like(shading), _CONDITION_CAP, dominant_direction(light))


def _condition(gram: NDArray[np.float64]) -> float:
    """Condition number of the design matrix behind a Gram matrix, capped."""
    values = np.linalg.eigvalsh(gram)
    return float(
        min(np.sqrt(max(values[-1], 0) / max(values[0], values[-1] / _CONDITION_CAP**2, 1e-300)), _CONDITION_CAP)
    )
