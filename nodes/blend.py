"""Putting a picture together again from its parts."""

from __future__ import annotations

import os
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node
from graphface.nodes.detail.rendering import applied, rendering
from graphface.nodes.types import Albedo, DetailMap, FloatArray, Image, Shading

_STRIP = 1 << 15
"""Values worked on at a time: a dozen arrays of 128 KB."""


@node("blend.recombine")
def recombine(
    photo: Image,
    albedo: Albedo,
    shading: Shading,
    detail: DetailMap,
    *,
    shoulder: Annotated[float, Field(ge=0, le=1)] = 0.5,
) -> Image:
    """I(x) = rho(x) s(x) + I_d(x) (paper, equation 3), over the whole picture, kept within what a picture can show.

    Args:
        photo: the picture before, in the encoding of albedo, shading and detail; alpha and file format come from it.
        shading: H x W or H x W x 3.
        shoulder: how much of the room between a pixel and white (or black, where it gets darker) is used to bend an
            overshooting change instead of clipping it; 0 clips. A pixel that does not change is never touched.
            (Measured on path-traced heads: 0.5 gains 0.1 dB over 0 and loses nothing anywhere; 1 costs 1 to 2 dB.)

    Returns:
        An image in the photo's encoding, within [0, 1] (or the photo's own range where that is wider).
    """
    pixels = np.empty_like(photo.pixels)

    def strip(rows: slice) -> None:
        before, part = photo.pixels[rows], _strip(detail, rows)
        change = applied(part, rendering(albedo[rows], shading[rows]))
        change -= before
        np.add(before, _bend(change, before, shoulder), out=pixels[rows])

    with ThreadPoolExecutor(min(4, os.cpu_count() or 1)) as pool:
        list(pool.map(strip, _strips(photo)))
    return photo.with_pixels(pixels)


def _strips(photo: Image) -> Iterator[slice]:
    """Rows at a time whose values stay in the processor's cache: twice as fast as all at once."""
    step = max(1, _STRIP // max(1, 3 * photo.width))
    return (slice(top, top + step) for top in range(0, photo.height, step))


def _strip(detail: DetailMap, rows: slice) -> DetailMap:
    gain, pivot = (None if part is None else part[rows] for part in (detail.gain, detail.pivot))
    return DetailMap(detail.offset[rows], gain, pivot)


def _bend(change: FloatArray, pixels: FloatArray, shoulder: float) -> FloatArray:
    """The change, soft-limited to the room that each value has left to 1 (or to 0, where it gets darker).

    Up to the share 1 - shoulder of its room r a change passes as it is; beyond, it nears r exponentially, without a
    kink. Each channel has its own room, so bright colours drift to white as on film. (One factor for all channels
    keeps the hue, and was rejected: where one channel is full already the others are held back in patches.)
    """
    room = np.maximum(np.where(change > 0, 1 - pixels, pixels), 0)
    size = np.abs(change)
    free = room * np.float32(1 - shoulder)
    over = size > free
    if shoulder > 0 and over.any():
        kept = free[over]
        rest = np.maximum(room[over] - kept, np.float32(1e-6))
        size[over] = kept - rest * np.expm1((kept - size[over]) / rest)
    return np.copysign(np.minimum(size, room), change)
