"""Photographs, as they are and as a backdrop."""

from __future__ import annotations

from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from graphface.nodes.color import encode_srgb
from graphface.nodes.types import FloatArray, Image
from graphface.pictures.colors import as_bytes, share_beyond, with_odd
from graphface.values.picture import Picture, View, picked

Pixels = NDArray[np.uint8]

_DARKENED = (20 + 0.62 * np.arange(256)).astype(np.uint8)
"""From the grey of a photo to that of a backdrop."""
_CHECKER = 8
"""Pixels of a square behind what is transparent."""


def draw_image(image: Image, view: View) -> Picture:
    """The photo, encoded to sRGB; over a checkerboard where it is transparent."""
    seen = view.sampled(image.pixels)
    channels: tuple[str, ...] = ("red", "green", "blue")
    data, note = seen, f"{image.encoding} values; white is 1"
    pixels = bytes_of(image, seen)
    if image.alpha is not None:
        alpha = view.sampled(image.alpha)
        data, channels = np.concatenate([seen, alpha[..., None]], axis=2), (*channels, "alpha")
        rows, columns = (np.arange(n) // _CHECKER for n in alpha.shape)
        board = np.where((rows[:, None] + columns) % 2, 110, 150)[..., None]
        cover = np.clip(np.nan_to_num(alpha), 0, 1)[..., None]
        pixels = np.rint(pixels * cover + board * (1 - cover)).astype(np.uint8)
    over = share_beyond(seen, 1)
    note += f", {over:.1%} of the pixels are brighter" if over >= 0.0005 else ""
    return Picture(pixels, with_odd(note, seen), data, channels, (image.height, image.width))


def bytes_of(image: Image, pixels: FloatArray | None = None) -> Pixels:
    """A photo's pixels, or some of them, as sRGB bytes H x W x 3."""
    values = image.pixels if pixels is None else pixels
    return as_bytes(encode_srgb(values) if image.encoding == "linear" else values)


def photo_for(view: View, full: tuple[int, ...], shown: tuple[int, ...]) -> Pixels | None:
    """The photo that a drawn map belongs to, in the map's pixels: uint8 h x w x 3; None where there is none.

    Args:
        full: height and width of the map. shown: of its picture.

    A photo of another aspect is another photo.
    """
    photo = view.above(Image)
    if photo is None or 0 in photo.pixels.shape:
        return None
    if abs(photo.width * full[0] - photo.height * full[1]) > 0.02 * photo.height * full[1]:
        return None
    rows, columns = picked(photo.height, shown[0]), picked(photo.width, shown[1])
    return bytes_of(photo, photo.pixels.take(rows, axis=0).take(columns, axis=1))


def backdrop(view: View, full: tuple[int, ...], shown: tuple[int, ...]) -> Pixels:
    """As `photo_for`, grey and darkened so that colors show on it; plain grey where there is no photo."""
    photo = photo_for(view, full, shown)
    if photo is None:
        return np.full((*shown[:2], 3), 64, np.uint8)
    return darkened(photo)


def darkened(photo: Pixels) -> Pixels:
    """Grey, and so dark that colors show on it."""
    grey = cv2.cvtColor(photo, cv2.COLOR_RGB2GRAY)
    return np.asarray(cv2.cvtColor(_DARKENED[grey], cv2.COLOR_GRAY2RGB))


def tinted(under: Pixels, weights: list[FloatArray], colors: list[Any], strength: float = 0.6) -> Pixels:
    """A picture with colors laid over it, each with its weight H x W, 0..1, one after the other."""
    mixed = under
    for weight, color in zip(weights, colors, strict=True):
        cover = np.clip(np.nan_to_num(weight), 0, 1).astype(np.float32) * np.float32(strength)
        plain = np.empty_like(mixed)
        for channel in range(3):  # faster than all three at once
            plain[..., channel] = color[channel]
        mixed = np.asarray(cv2.blendLinear(plain, mixed, cover, 1 - cover))
    return mixed.copy() if mixed is under else mixed
