"""Pictures at another size."""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated

import cv2
import numpy as np
from pydantic import Field

from graphface import node
from graphface.nodes.color import decode_srgb, encode_srgb
from graphface.nodes.types import Image


@node("image.resize")
def resize(
    photo: Image,
    *,
    long_side: Annotated[int, Field(ge=1, le=30_000)],
    enlarge: bool = False,
) -> Image:
    """The picture with its longer side `long_side` pixels long, resampled in linear light.

    Args:
        photo: any picture; the same object is returned if it has that size already.
        long_side: in pixels; the aspect ratio is kept, and the shorter side is at least 1.
        enlarge: whether a smaller picture is enlarged (bicubic) or left as it is. A larger one is always reduced, by
            the mean over areas.
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
