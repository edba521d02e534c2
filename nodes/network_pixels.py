"""Pixels in the encoding and range that networks trained on photographs expect."""

from __future__ import annotations

import numpy as np

from graphface.nodes.color import encode_srgb
from graphface.nodes.types import Encoding, FloatArray


def network_pixels(pixels: FloatArray, encoding: Encoding) -> FloatArray:
    """sRGB-encoded pixels within 0..1; NaN becomes 0.

    >>> network_pixels(np.float32([[[np.nan, 0.5, 2]]]), "srgb").tolist()
    [[[0.0, 0.5, 1.0]]]
    """
    if encoding == "linear":
        pixels = encode_srgb(pixels)
    return np.clip(np.nan_to_num(pixels, nan=0, posinf=1, neginf=0), 0, 1)
