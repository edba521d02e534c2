"""What all methods of scattering share: the change of light, in linear values, smoothed on a grid in face units."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from graphface.nodes.color import decode_srgb, encode_srgb
from graphface.nodes.pixel_grid import grid_middles
from graphface.nodes.strips import by_strips
from graphface.nodes.types import FloatArray, Image, Landmarks, Shading, Surface

FINEST = 64.0
"""Points per inter-ocular distance of the grid: the widest Gaussian of skin is two of them."""


Blur = Callable[[FloatArray, FloatArray, FloatArray, float], FloatArray]
"""Change h x w x c, inside and depth h x w, points per inter-ocular distance: the smoothed change, h x w x c or 3."""


def smoothed_change(
    shading: Shading, estimated: Shading, surface: Surface, landmarks: Landmarks, photo: Image, blur: Blur
) -> Shading:
    """`shading` with its difference to `estimated` blurred in linear light, on the surface only.

    The blur works on a grid, and what it changes there is enlarged and added to the full shading: where it does
    nothing, nothing is lost.
    """
    import cv2

    encoded = photo.encoding == "srgb"
    unit = max(landmarks.interocular, 1e-3)
    scale = min(1.0, FINEST / unit)
    height, width = surface.coverage.shape
    rows, columns = grid_middles(height, scale), grid_middles(width, scale)
    window = _covered_window(surface.coverage[np.ix_(rows, columns)])
    if window is None:
        return shading
    grid = np.ix_(rows[window[0]], columns[window[1]])
    before = _channels(shading[grid])
    old, new = (_channels(decode_srgb(v) if encoded else v) for v in (estimated[grid], before))
    inside, depth = surface.coverage[grid], surface.depth[grid]
    change = (new - old) * inside[..., None]
    linear = np.maximum(new + (blur(change, inside, depth, unit * scale) - change) * inside[..., None], 0)
    step = np.zeros((len(rows), len(columns), linear.shape[2]), np.float32)
    step[window] = (encode_srgb(linear) if encoded else linear) - before
    if step.shape[:2] != (height, width):
        step = _channels(np.asarray(cv2.resize(step, (width, height), interpolation=cv2.INTER_LINEAR), np.float32))
    result = np.empty_like(step)

    def strip(rows: slice) -> None:
        step[rows] *= surface.coverage[rows, :, None]
        np.maximum(_channels(shading[rows]) + step[rows], 0, out=result[rows])

    by_strips(strip, result.shape)
    return result if result.shape[2] > 1 else result[..., 0]


def _covered_window(coverage: FloatArray) -> tuple[slice, slice] | None:
    """The rows and columns that hold all of the surface and one cell around it; None: there is no surface."""
    down, across = (np.flatnonzero(coverage.any(axis=axis)) for axis in (1, 0))
    if not len(down):
        return None
    return slice(max(down[0] - 1, 0), down[-1] + 2), slice(max(across[0] - 1, 0), across[-1] + 2)


def _channels(values: FloatArray) -> FloatArray:
    return values if values.ndim == 3 else values[..., None]
