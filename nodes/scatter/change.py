"""What all methods of scattering share: the change of light, in linear values, smoothed on a grid in face units."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from graphface.nodes.colour import decode_srgb, encode_srgb
from graphface.nodes.render.places import grid_middles
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
    grid = np.ix_(grid_middles(height, scale), grid_middles(width, scale))
    before = _channels(shading[grid])
    old, new = (_channels(decode_srgb(v) if encoded else v) for v in (estimated[grid], before))
    inside, depth = surface.coverage[grid], surface.depth[grid]
    change = (new - old) * inside[..., None]
    linear = np.maximum(new + (blur(change, inside, depth, unit * scale) - change) * inside[..., None], 0)
    step = np.asarray((encode_srgb(linear) if encoded else linear) - before, np.float32)
    if step.shape[:2] != (height, width):
        step = _channels(np.asarray(cv2.resize(step, (width, height), interpolation=cv2.INTER_LINEAR), np.float32))
    step *= surface.coverage[..., None]
    result: FloatArray = np.maximum(_channels(shading) + step, 0)
    return result if result.shape[2] > 1 else result[..., 0]


def _channels(values: FloatArray) -> FloatArray:
    return values if values.ndim == 3 else values[..., None]
