"""Pictures as values: from arrays, between encodings, at another size. Files are `image_read` and `image_write`."""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated, Any

import cv2
import numpy as np
from pydantic import Field

from graphface import node
from graphface.nodes.colour import decode_srgb, encode_srgb
from graphface.nodes.image_read import read_image
from graphface.nodes.image_text import read_text
from graphface.nodes.image_write import write_image, write_picture
from graphface.nodes.types import Encoding, FileFormat, FloatArray, Image

__all__ = [
    "decode_srgb",
    "encode",
    "encode_srgb",
    "image_from_array",
    "read_image",
    "read_text",
    "resize",
    "write_image",
    "write_picture",
]

BRIGHTEST = 64.0
"""A float picture above this is taken for one in 0..255, and refused."""


@node("image.encode")
def encode(photo: Image, *, encoding: Encoding) -> Image:
    """The same picture with its values sRGB-encoded or in linear light; the same object where it already is."""
    if photo.encoding == encoding:
        return photo
    change = encode_srgb if encoding == "srgb" else decode_srgb
    return photo.with_pixels(change(photo.pixels), encoding)


@node("image.resize")
def resize(
    photo: Image,
    *,
    long_side: Annotated[int, Field(ge=1, le=30_000)],
    enlarge: bool = False,
) -> Image:
    """The picture with its longer side `long_side` pixels long, resampled in linear light.

    Args:
        photo: any picture; the same object is returned where it already fits.
        long_side: in pixels; the shorter side follows, at least 1.
        enlarge: whether a smaller picture is enlarged (cubic) or left as it is.
    """
    longest = max(photo.width, photo.height)
    if longest == long_side or (longest < long_side and not enlarge):
        return photo
    scale = long_side / longest
    size = (max(1, round(photo.width * scale)), max(1, round(photo.height * scale)))
    method = cv2.INTER_AREA if scale < 1 else cv2.INTER_CUBIC
    linear = photo.pixels if photo.encoding == "linear" else decode_srgb(photo.pixels)
    pixels = np.asarray(cv2.resize(linear, size, interpolation=method), dtype=np.float32)
    alpha = None
    if photo.alpha is not None:
        alpha = np.clip(cv2.resize(photo.alpha, size, interpolation=method), 0, 1).astype(np.float32)
    pixels = pixels if photo.encoding == "linear" else encode_srgb(pixels)
    return replace(photo, pixels=pixels, alpha=alpha)


def image_from_array(value: object) -> Image:
    """A picture from what people have in a notebook.

    Args:
        value: an `Image` (returned as it is), or an array of H x W, H x W x 1 (grey), H x W x 3 (RGB) or H x W x 4
            (RGB and alpha): uint8, uint16, bool, or floating in 0..1. The array is copied.

    Raises:
        ValueError: another shape, dtype or range, no pixels, or values that are not numbers.
    """
    if isinstance(value, Image):
        return value
    array = np.asarray(value)
    if array.ndim == 2:
        array = array[..., None]
    if array.ndim != 3 or array.shape[2] not in (1, 3, 4) or array.size == 0:
        raise ValueError(
            f"expected a picture of H x W, H x W x 3 or H x W x 4, got {type(value).__name__} of shape "
            f"{np.asarray(value).shape}"
        )
    unit = _unit(array)
    channels = unit.shape[2]
    pixels = np.repeat(unit, 3, axis=2) if channels == 1 else np.ascontiguousarray(unit[..., :3])
    alpha = np.ascontiguousarray(unit[..., 3]) if channels == 4 else None
    bits = 16 if array.dtype.itemsize > 1 else 8
    return Image(pixels, alpha, file=FileFormat(bits=bits, grey=channels == 1))


def _unit(array: np.ndarray[Any, np.dtype[Any]]) -> FloatArray:
    """A float32 copy in 0..1."""
    if array.dtype in (np.uint8, np.uint16):
        return array.astype(np.float32) / np.float32(np.iinfo(array.dtype).max)
    if array.dtype == np.bool_:
        return array.astype(np.float32)
    if array.dtype.kind != "f":
        raise ValueError(f"expected a picture of uint8, uint16, bool or floating values, got {array.dtype}")
    if not np.isfinite(array).all():
        raise ValueError("the picture has values that are not numbers (NaN or infinite)")
    brightest = float(np.abs(array).max())
    if brightest > BRIGHTEST:
        raise ValueError(f"floating pictures are nominally 0..1, this one reaches {brightest:.4g}; divide it by 255?")
    return array.astype(np.float32)
