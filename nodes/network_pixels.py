"""Pixels as networks that were trained on photographs know them."""

from __future__ import annotations

import numpy as np

from graphface.nodes.color import encode_srgb
from graphface.nodes.types import Encoding, FloatArray


def network_pixels(pixels: FloatArray, encoding: Encoding) -> FloatArray:
    """Pixels as the networks know them: sRGB-encoded, within 0..1, finite (what is not a number is black)."""
    if encoding == "linear":
        pixels = encode_srgb(pixels)
    return np.clip(np.nan_to_num(pixels, nan=0, posinf=1, neginf=0), 0, 1)
