"""Pictures of values that have no colors of their own: uint8 H x W x 3."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float32]


def as_bytes(unit: NDArray[np.floating[Any]]) -> NDArray[np.uint8]:
    """Values in 0..1, H x W or H x W x 3, as bytes; clipped."""
    pixels = np.rint(np.clip(unit, 0, 1) * 255).astype(np.uint8)
    return pixels if pixels.ndim == 3 else np.repeat(pixels[..., None], 3, axis=2)


def picture_unit(values: FloatArray) -> NDArray[np.uint8]:
    """Black is 0, white is 1."""
    return as_bytes(values)


def picture_albedo(albedo: FloatArray) -> NDArray[np.uint8]:
    """Mid grey is 1, the mean of color over intensity."""
    return as_bytes(albedo / 2)


def picture_normals(normals: FloatArray) -> NDArray[np.uint8]:
    """Colors (n + 1) / 2; black where there is no surface."""
    covered = np.any(normals != 0, axis=2, keepdims=True)
    return as_bytes(np.where(covered, (normals + 1) / 2, 0))


def picture_signed(values: FloatArray) -> NDArray[np.uint8]:
    """Mid grey is 0."""
    return as_bytes(values + 0.5)


def picture_gain(values: FloatArray) -> NDArray[np.uint8]:
    """Mid grey is 1."""
    return as_bytes(values / 2)


def picture_depth(depth: FloatArray) -> NDArray[np.uint8]:
    """White is near, dark is far, black where there is no surface."""
    covered = depth != 0
    if not covered.any():
        return as_bytes(np.zeros_like(depth))
    low, high = depth[covered].min(), depth[covered].max()
    return as_bytes(np.where(covered, 0.15 + 0.85 * (depth - low) / max(high - low, 1e-6), 0))
