"""Color as numbers: sRGB encoding, linear light, other color spaces, and the mean of the channels.

The encoding is that of IEC 61966-2-1, exact and piecewise, extended to negative values as an odd function. Both
directions work through the picture in blocks that stay in the processor's cache, which is three times faster.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Literal

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float32]


ColorSpace = Literal["lab", "rgb", "ycrcb", "hsv"]


_LINEAR_KNEE, _ENCODED_KNEE = 0.0031308, 0.04045
"""The two ends of the straight piece of the sRGB curve (IEC 61966-2-1), in linear light and encoded."""


_BLOCK = 1 << 15
"""Values in a block: 128 KB."""


def encode_srgb(linear: FloatArray) -> FloatArray:
    """Linear light to sRGB (IEC 61966-2-1); values above 1 follow the same curve, negative ones its mirror image.

    Args:
        linear: float32 of any shape; 1 is white.

    Returns:
        float32 of the same shape.

    >>> encode_srgb(np.float32([0, 0.2140411, 1, -0.2140411])).round(4)
    array([ 0. ,  0.5,  1. , -0.5], dtype=float32)
    """
    return _blockwise(_encode, linear)


def decode_srgb(encoded: FloatArray) -> FloatArray:
    """sRGB to linear light, the inverse of `encode_srgb`: float32 of the same shape.

    >>> decode_srgb(np.float32([0, 0.04045, 0.5, 1])).round(4)
    array([0.    , 0.0031, 0.214 , 1.    ], dtype=float32)
    """
    return _blockwise(_decode, encoded)


def in_space(pixels: FloatArray, space: ColorSpace) -> FloatArray:
    """Convert RGB to another color space, each channel scaled to a range of about 1.

    Args:
        pixels: float32 H x W x 3 RGB in [0, 1].
        space: "lab" is CIE L*a*b* over 100 and 50; "ycrcb" and "rgb" are in [0, 1]; "hsv" has the hue as a point of the
            color disc, (s cos h, s sin h, v), because an angle jumps at red.

    Returns:
        float32 H x W x 3.

    >>> in_space(np.float32([[[1, 1, 1]]]), "lab").round(3) + 0
    array([[[1., 0., 0.]]], dtype=float32)
    """
    import cv2

    if space == "rgb":
        return pixels
    if space == "hsv":
        hsv = cv2.cvtColor(pixels, cv2.COLOR_RGB2HSV)
        hue = np.radians(hsv[..., 0])
        return np.stack([hsv[..., 1] * np.cos(hue), hsv[..., 1] * np.sin(hue), hsv[..., 2]], axis=2).astype(np.float32)
    if space == "ycrcb":
        return np.asarray(cv2.cvtColor(pixels, cv2.COLOR_RGB2YCrCb), np.float32)
    lab = np.asarray(cv2.cvtColor(pixels, cv2.COLOR_RGB2Lab), np.float32)
    return lab * np.asarray([0.01, 0.02, 0.02], np.float32)


def lab(pixels: FloatArray) -> FloatArray:
    """CIE Lab of sRGB-encoded pixels H x W x 3, which are limited to 0..1: L 0..100, a and b about -128..127.

    >>> lab(np.float32([[[1, 1, 1]]])).round(1) + 0
    array([[[100.,   0.,   0.]]], dtype=float32)
    """
    import cv2

    return np.asarray(cv2.cvtColor(np.clip(pixels, 0, 1).astype(np.float32), cv2.COLOR_RGB2Lab), np.float32)


def channel_mean(values: FloatArray) -> FloatArray:
    """The mean of R, G and B, H x W: the paper's intensity. A map without channels, H x W, is returned as it is.

    `values.mean(axis=2)` takes thirty times as long, because the axis is so short.

    >>> channel_mean(np.float32([[[0.25, 0.5, 0.75]]]))
    array([[0.5]], dtype=float32)
    """
    if values.ndim == 2:
        return values
    mean: FloatArray = values[..., 0] + values[..., 1]
    mean += values[..., 2]
    mean *= np.float32(1 / 3)
    return mean


def in_three_channels(values: FloatArray) -> FloatArray:
    """A map H x W repeated in three channels, H x W x 3: a new array.

    Multiplying by it is several times faster than broadcasting `values[..., None]`, because the axis is so short.

    >>> in_three_channels(np.float32([[0.5]]))
    array([[[0.5, 0.5, 0.5]]], dtype=float32)
    """
    import cv2

    if values.dtype != np.float32 or values.size == 0:
        return np.repeat(values[..., None], 3, axis=2)
    return np.asarray(cv2.cvtColor(values, cv2.COLOR_GRAY2RGB))


def with_channels_of(values: FloatArray, like: FloatArray) -> FloatArray:
    """`values` as they are, or repeated in three channels where they have none and `like` has three.

    >>> with_channels_of(np.ones((2, 5), np.float32), np.ones((4, 5, 3), np.float32)).shape
    (2, 5, 3)
    """
    return in_three_channels(values) if values.ndim < like.ndim else values


def _encode(magnitude: FloatArray) -> FloatArray:
    import cv2

    encoded: FloatArray = np.asarray(cv2.pow(magnitude, 1 / 2.4), dtype=np.float32).reshape(-1)
    encoded *= np.float32(1.055)
    encoded -= np.float32(0.055)
    dark = np.flatnonzero(magnitude <= _LINEAR_KNEE)  # few; `where=` would cost twice the power
    encoded[dark] = magnitude[dark] * np.float32(12.92)
    return encoded


def _decode(magnitude: FloatArray) -> FloatArray:
    import cv2

    base = (magnitude + np.float32(0.055)) / np.float32(1.055)
    linear: FloatArray = np.asarray(cv2.pow(base, 2.4), dtype=np.float32).reshape(-1)
    dark = np.flatnonzero(magnitude <= _ENCODED_KNEE)
    linear[dark] = magnitude[dark] / np.float32(12.92)
    return linear


def _blockwise(curve: Callable[[FloatArray], FloatArray], values: FloatArray) -> FloatArray:
    """`curve` of the magnitudes, with the signs of the values."""
    flat = np.ascontiguousarray(values, dtype=np.float32).reshape(-1)
    out = np.empty_like(flat)
    for start in range(0, flat.size, _BLOCK):
        block = slice(start, start + _BLOCK)
        part = flat[block]
        if part.min() >= 0:
            out[block] = curve(part)
        else:
            np.copysign(curve(np.abs(part)), part, out=out[block])
    return out.reshape(np.shape(values))
