"""What all methods of scattering share: the change of light, in linear values, smoothed on a small copy."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from graphface.nodes.colour import decode_srgb, encode_srgb
from graphface.nodes.types import FloatArray, Image, Landmarks, Shading, Surface

FINEST = 64.0
"""Points per inter-ocular distance of the copy that is smoothed; what is lost on it is put back."""

Blur = Callable[[FloatArray, FloatArray, float], FloatArray]
"""Change h x w x c, inside h x w, points per inter-ocular distance: the smoothed change, h x w x c or x 3."""


def smoothed_change(
    shading: Shading, estimated: Shading, surface: Surface, landmarks: Landmarks, photo: Image, blur: Blur
) -> Shading:
    """`shading` with its difference to `estimated` blurred in linear light, on the surface only.

    The blur works on a small copy, and what it takes away there is enlarged and taken away from the full shading: where
    it does nothing, nothing is lost.
    """
    import cv2

    encoded = photo.encoding == "srgb"
    old, new = (_channels(decode_srgb(v) if encoded else v) for v in (estimated, shading))
    unit = max(landmarks.interocular, 1e-3)
    scale = min(1.0, FINEST / unit)
    height, width = surface.coverage.shape
    size = (max(1, round(width * scale)), max(1, round(height * scale)))
    inside = np.asarray(cv2.resize(surface.coverage, size, interpolation=cv2.INTER_AREA), np.float32)
    covered = _channels(surface.coverage)
    change = _channels(np.asarray(cv2.resize((new - old) * covered, size, interpolation=cv2.INTER_AREA), np.float32))
    change = change / np.maximum(inside, np.float32(1e-3))[..., None]
    taken = np.asarray(blur(change, inside, unit * scale) - change, np.float32)
    linear = new + _channels(np.asarray(cv2.resize(taken, (width, height)), np.float32)) * covered
    linear = np.maximum(linear, 0)
    result = encode_srgb(linear) if encoded else linear
    return result if result.shape[2] > 1 else result[..., 0]


def _channels(values: FloatArray) -> FloatArray:
    return values if values.ndim == 3 else values[..., None]
