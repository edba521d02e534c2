"""What the methods of scattering share: the change of light, in linear values, smoothed on a grid in face units."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from graphface.nodes.bounding_box import bounding_box
from graphface.nodes.color import decode_srgb, encode_srgb
from graphface.nodes.pixel_grid import grid_middles
from graphface.nodes.strips import by_strips
from graphface.nodes.types import FloatArray, Image, Landmarks, Shading, Surface

RESOLUTION = 64.0
"""Points of the grid per inter-ocular distance, at most: the widest Gaussian of skin has a sigma of two of them."""


Smooth = Callable[[FloatArray, FloatArray, FloatArray, float], FloatArray]
"""Arguments: change h x w x c, coverage h x w, depth h x w in pixels, grid points per inter-ocular distance. Returns
the smoothed change, h x w x c or h x w x 3."""


def smoothed_change(
    shading: Shading, estimated: Shading, surface: Surface, landmarks: Landmarks, photo: Image, smooth: Smooth
) -> Shading:
    """`shading` with its difference to `estimated` smoothed in linear light, on the surface only.

    What the smoothing changes on the grid is enlarged and added to the shading, which keeps its own resolution.

    Args:
        shading, estimated: under the new and the photo's own light, H x W or H x W x 3, in the photo's encoding.

    Returns:
        float32 H x W or H x W x 3, by the channels that `smooth` returns.
    """
    import cv2

    encoded = photo.encoding == "srgb"
    interocular = max(landmarks.interocular, 1e-3)
    scale = min(1.0, RESOLUTION / interocular)
    height, width = surface.coverage.shape
    rows, columns = grid_middles(height, scale), grid_middles(width, scale)
    window = bounding_box(surface.coverage[np.ix_(rows, columns)], margin=1)
    if window is None:
        return shading
    grid = np.ix_(rows[window[0]], columns[window[1]])
    before = _with_channel_axis(shading[grid])
    old, new = (_with_channel_axis(decode_srgb(v) if encoded else v) for v in (estimated[grid], before))
    coverage, depth = surface.coverage[grid], surface.depth[grid]
    change = (new - old) * coverage[..., None]
    smoothed = smooth(change, coverage, depth, interocular * scale)
    linear = np.maximum(new + (smoothed - change) * coverage[..., None], 0)
    step = np.zeros((len(rows), len(columns), linear.shape[2]), np.float32)
    step[window] = (encode_srgb(linear) if encoded else linear) - before
    if step.shape[:2] != (height, width):
        enlarged = cv2.resize(step, (width, height), interpolation=cv2.INTER_LINEAR)
        step = _with_channel_axis(np.asarray(enlarged, np.float32))
    result = np.empty_like(step)

    def strip(rows: slice) -> None:
        step[rows] *= surface.coverage[rows, :, None]
        np.maximum(_with_channel_axis(shading[rows]) + step[rows], 0, out=result[rows])

    by_strips(strip, result.shape)
    return result if result.shape[2] > 1 else result[..., 0]


def _with_channel_axis(values: FloatArray) -> FloatArray:
    return values if values.ndim == 3 else values[..., None]
