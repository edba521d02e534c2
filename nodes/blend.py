"""Putting a picture together again from its parts."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node
from graphface.nodes.detail.rendering import applied, rendering
from graphface.nodes.strips import by_strips
from graphface.nodes.types import Albedo, DetailMap, FloatArray, Image, Shading

_LEAST_ROOM = 1e-6
"""Room that a value is taken to have at least, so that it can be divided by."""


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
    pixels = np.empty(photo.pixels.shape, np.float32)

    def strip(rows: slice) -> None:
        picture = applied(_strip(detail, rows), rendering(albedo[rows], shading[rows]))
        _bent(picture, photo.pixels[rows], shoulder, out=pixels[rows])

    by_strips(strip, pixels.shape)
    return photo.with_pixels(pixels)


def _strip(detail: DetailMap, rows: slice) -> DetailMap:
    parts = {name: getattr(detail, name) for name in ("gain", "pivot", "ceiling")}
    return DetailMap(detail.offset[rows], **{name: part[rows] for name, part in parts.items() if part is not None})


def _bent(picture: FloatArray, before: FloatArray, shoulder: float, out: FloatArray) -> None:
    """The new picture, its change soft-limited to the room that each value had left to 1 (or to 0, downwards).

    Up to the share 1 - shoulder of its room r a change passes as it is; beyond, it nears r exponentially, without a
    kink. Each channel has its own room, so bright colours drift to white as on film. (One factor for all channels
    keeps the hue, and was rejected: where one channel is full already the others are held back in patches.)
    """
    black, white = _limits(before)
    if shoulder == 0:
        np.maximum(picture, black, out=out)
        np.minimum(out, white, out=out)
        return
    straight = np.float32(1 - shoulder)
    knee = before * np.float32(shoulder)
    np.maximum(picture, knee if black is _BLACK else knee + straight * black, out=out)
    knee += straight * white
    np.minimum(out, knee, out=out)
    differs = picture != out
    count = np.count_nonzero(differs)
    if count * _FEW > picture.size:
        out[...] = _shouldered(picture, out, before, black, white, shoulder)
    elif count:
        places = np.flatnonzero(differs)
        few, knees, start = (values.reshape(-1).take(places) for values in (picture, out, before))
        low, high = (limit.reshape(-1).take(places) if limit.ndim else limit for limit in (black, white))
        out.reshape(-1)[places] = _shouldered(few, knees, start, low, high, shoulder)


_FEW = 8
"""Where fewer than one value in so many is beyond the knee, those are picked out."""

_BLACK, _WHITE = np.float32(0), np.float32(1)


def _limits(before: FloatArray) -> tuple[FloatArray | np.float32, FloatArray | np.float32]:
    """0 and 1; what the photo has beyond them it may keep."""
    black: FloatArray | np.float32 = _BLACK
    white: FloatArray | np.float32 = _WHITE
    if before.size and before.min() < 0:
        black = np.minimum(before, black)
    if before.size and before.max() > 1:
        white = np.maximum(before, white)
    return black, white


def _shouldered(
    picture: FloatArray,
    knee: FloatArray,
    before: FloatArray,
    black: FloatArray | np.float32,
    white: FloatArray | np.float32,
    shoulder: float,
) -> FloatArray:
    """Knee + R (1 - exp(-e / R)) for an excess e of the picture over the knee; R, the room there, has the sign of e.

    One formula serves both sides, for selecting one of two (`np.where`) costs as much as a dozen multiplications.
    """
    import cv2

    excess = np.subtract(knee, picture)  # -e
    # R = shoulder * (limit - before), kept away from 0 on its own side.
    upwards = cv2.threshold(excess, 0, 1, cv2.THRESH_BINARY_INV)[1]
    room = np.asarray(upwards, np.float32).reshape(excess.shape)
    room *= np.float32(shoulder) * (white - black) + np.float32(2 * _LEAST_ROOM)
    room += np.float32(shoulder) * black - np.float32(_LEAST_ROOM)
    room -= before * np.float32(shoulder)
    excess /= room
    np.expm1(excess, out=excess)
    excess *= room
    np.subtract(knee, excess, out=excess)
    np.maximum(excess, black, out=excess)
    return np.minimum(excess, white, out=excess)
