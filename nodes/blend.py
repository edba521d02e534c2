"""Putting a picture together again from its parts."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node
from graphface.nodes.detail import rendering
from graphface.nodes.types import Albedo, DetailMap, FloatArray, Image, Shading


@node("blend.recombine")
def recombine(
    photo: Image, albedo: Albedo, shading: Shading, detail: DetailMap, *, shoulder: Annotated[float, Field(ge=0, le=1)] = 0.5
) -> Image:
    """I(x) = rho(x) s(x) + I_d(x) (paper, equation 3), over the whole picture, kept within what a picture can show.

    Args:
        photo: the picture before, in the encoding of albedo, shading and detail; alpha and file format come from it.
        shading: H x W or H x W x 3.
        shoulder: how much of the room between a pixel and white (or black, where it gets darker) is used to bend an
            overshooting change instead of clipping it; 0 clips. A pixel that does not change is never touched.

    Returns:
        An image in the photo's encoding, within [0, 1] (or the photo's own range where that is wider).
    """
    rendered = rendering(albedo, shading)
    if detail.gain is not None:
        rendered = rendered * detail.gain
    change = rendered + detail.offset - photo.pixels
    return photo.with_pixels(photo.pixels + _bend(change, photo.pixels, shoulder))


def _bend(change: FloatArray, pixels: FloatArray, shoulder: float) -> FloatArray:
    """The change, soft-limited to the room that each value has left.

    Beyond the first (1 - shoulder) of the room a change d of room r becomes r (1 - exp(-d / r)): slope 1 at the start, never
    past the end. Each channel has its own room, so bright colours drift to white as film does.
    """
    room = np.where(change > 0, 1 - pixels, pixels)
    room = np.maximum(room, 0)
    if shoulder == 0:
        return np.clip(change, -room, room)
    start = room * np.float32(1 - shoulder)
    soft = np.maximum(room - start, np.float32(1e-6))
    size = np.abs(change)
    bent = start + soft * -np.expm1(-np.maximum(size - start, 0) / soft)
    return np.copysign(np.minimum(np.where(size > start, bent, size), room), change)
