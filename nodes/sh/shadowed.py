"""The estimated shading with the shadows that the photo's own lamp casts."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from graphface import node
from graphface.nodes.color import channel_mean
from graphface.nodes.harmonics import basis, sphere_points
from graphface.nodes.types import FloatArray, Lighting, Mask, Shading

_DIRECTIONS = 200
"""In which the least irradiance is looked for."""

_LIT, _DARK = 0.05, 0.5
"""Shadow up to which skin counts as lit, and from which it must be seen somewhere."""

_ENOUGH = 0.05
"""Share of the face that must be lit for its brightness to be the measure."""

_SAMPLES = 1 << 15


@node("sh.shadowed")
def shadowed(
    estimated: Shading,
    light: Lighting,
    shadow: Mask,
    shading: Shading,
    mask: Mask,
    *,
    strength: Annotated[float, Field(ge=0, le=1)] = 1.0,
    floor: Annotated[float, Field(ge=0, le=1)] = 0.05,
) -> Shading:
    """Estimated shading, darker where the photo's strongest lamp is blocked.

    s' = s - d m (s - s_min), with the least irradiance s_min that the light gives in any direction: what is left
    without its strongest side. The depth d is measured: the shadow is real as far as it explains the photo's shading,

        d = argmin_{0 <= d <= 1} sum_x w(x) (t(x) / a - s(x) + d m(x) (s(x) - s_min))^2

    with a, the median of t / s where no shadow is. What only looks like a shadow has no depth.

    Args:
        estimated: s, of the light on the surface, H x W or H x W x 3.
        light: the same light.
        shadow: m, 0..1 (`surface.refined`). shading: t, of the photo by an intrinsic method, H x W (x 3).
        mask: w, the skin on which the depth is measured.
        strength: factor of the depth.
        floor: least shading, as in `sh.render`.

    Returns:
        Like `estimated`; the same array where there is no shadow.
    """
    if strength == 0 or not shadow.any() or light.order == 0:
        return estimated
    towards = basis(sphere_points(_DIRECTIONS).astype(np.float32), light.order) @ light.coefficients
    least = np.asarray(np.maximum(towards.min(axis=0), floor), np.float32)
    depth = strength * _depth(estimated, least, shadow, shading, mask)
    if depth == 0:
        return estimated
    rows, columns = _window(shadow)
    own, part = estimated[rows, columns], np.float32(depth) * shadow[rows, columns]
    fall = (part if own.ndim == 2 else part[..., None]) * np.maximum(own - least, 0)
    found = estimated.copy()
    found[rows, columns] = own - fall
    return found


def _depth(estimated: Shading, least: FloatArray, shadow: Mask, shading: Shading, mask: Mask) -> float:
    """The share of the strongest lamp that the shadow lacks, 0..1."""
    stride = max(1, int(np.sqrt(np.count_nonzero(mask) / _SAMPLES)))
    grid = np.s_[::stride, ::stride]
    own, seen = (np.asarray(channel_mean(values[grid]), np.float64) for values in (estimated, shading))
    weight = np.where(np.isfinite(seen) & (own > 0), mask[grid], 0)
    seen, blocked = np.nan_to_num(seen, posinf=0, neginf=0), shadow[grid]
    if weight[blocked > _DARK].sum() == 0:
        return 0.0
    lit = weight * (blocked < _LIT)
    usual = _median(seen / np.maximum(own, 1e-3), lit) if lit.sum() > _ENOUGH * weight.sum() else 1.0
    fall = blocked * np.maximum(own - float(np.mean(least)), 0)
    explained = float((weight * fall * (own - seen / max(usual, 0.2))).sum())
    possible = float((weight * fall * fall).sum())
    return float(np.clip(explained / max(possible, 1e-9), 0, 1))


def _median(values: NDArray[np.float64], weight: NDArray[np.float64]) -> float:
    on = weight > 0
    order = np.argsort(values[on])
    total = np.cumsum(weight[on][order])
    return float(values[on][order][np.searchsorted(total, total[-1] / 2)])


def _window(shadow: Mask) -> tuple[slice, slice]:
    """Rows and columns about a shadow."""
    rows, columns = (np.flatnonzero(shadow.any(axis=axis)) for axis in (1, 0))
    return slice(rows[0], rows[-1] + 1), slice(columns[0], columns[-1] + 1)
