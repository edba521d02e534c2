"""Albedo, shading and detail put together again.

`rendering` is what every detail map is measured against, `applied` puts a map onto another rendering, and `recombined`
keeps the result within what a picture can show.
"""

from __future__ import annotations

import numpy as np

from graphface.nodes.color import in_three_channels
from graphface.nodes.strips import by_strips
from graphface.nodes.types import Albedo, DetailMap, FloatArray, Image, Shading


def rendering(albedo: Albedo, shading: Shading) -> FloatArray:
    """rho(x) s(x), H x W x 3, for a grey (H x W) or colored (H x W x 3) shading."""
    if shading.ndim == 3:
        return albedo * shading
    rendered = in_three_channels(shading)
    rendered *= albedo
    return rendered


def applied(detail: DetailMap, rendered: FloatArray) -> FloatArray:
    """The picture that a detail map makes of a rendering, H x W x 3, unbounded; see `DetailMap` for the equation.

    `rendered` is used up: its memory serves as scratch.
    """
    beyond = None
    picture = rendered
    if detail.pivot is not None:
        picture = np.minimum(rendered, detail.pivot)
        beyond = np.subtract(rendered, picture, out=rendered)
    if detail.gain is not None:
        picture *= detail.gain
    picture += detail.offset
    if detail.ceiling is not None:
        np.minimum(picture, detail.ceiling, out=picture)
    if beyond is not None:
        picture += beyond
    return picture


_LEAST_ROOM = 1e-6
"""Room that a value is taken to have at least, so that it can be divided by."""


def recombined(photo: Image, albedo: Albedo, shading: Shading, detail: DetailMap, shoulder: float = 0.5) -> Image:
    """A picture from its parts; see `blend.recombine`."""
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
    kink. Each channel has its own room, so bright colors drift to white as on film. (One factor for all channels
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
