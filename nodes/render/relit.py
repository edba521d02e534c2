"""The relit picture."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import Lazy, Needs, UsageError, node
from graphface.nodes.color import decode_srgb, encode_srgb
from graphface.nodes.rendering import recombined
from graphface.nodes.strips import by_strips
from graphface.nodes.types import Albedo, DetailMap, FloatArray, Image, Scene, Shading


def _needs(scene: Scene) -> Needs:
    if scene.unchanged:
        same = "the scene is the photo's own light: nothing changes"
        return {"albedo": same, "shading": same, "detail": same, "highlights": same}
    dull = "the scene has no light that makes highlights, or asks for none (specular: 0)"
    return {"albedo": True, "shading": True, "detail": True, "highlights": scene.glossy or dull}


@node("render.relit", needs=_needs)
def relit(
    photo: Image,
    scene: Scene,
    albedo: Lazy[Albedo] = None,
    shading: Lazy[Shading] = None,
    detail: Lazy[DetailMap] = None,
    highlights: Lazy[Shading] = None,
    *,
    shoulder: Annotated[float, Field(ge=0, le=1)] = 0.5,
    toe: Annotated[float, Field(ge=0, le=1)] = 0.25,
) -> Image:
    """I^(n)(x) = rho(x) s^(n)(x) + I_d(x) (paper, equation 5), plus highlights.

    A scene that is the photo's own light returns the photo itself.

    Args:
        photo: the picture before, in the encoding of albedo, shading and detail.
        shading: s^(n), under the new light, H x W or H x W x 3.
        highlights: linear light that is added, H x W x 3.
        shoulder, toe: see `blend.recombine`. A large toe keeps the depth of a shadow grey and lit under a colored lamp.
            (Path-traced heads under left80_hard: 0.5 27.3, 0.25 28.0 dB, two heads of another family 24.6 and 24.7;
            squared error on the Yale set 0.0097 and 0.0098.)

    Raises:
        UsageError: albedo, shading or detail is missing, and the scene changes the light.
    """
    if scene.unchanged:
        return photo
    if albedo is None or shading is None or detail is None:
        raise UsageError("render.relit needs albedo, shading and detail unless the scene leaves the photo as it is")
    image = recombined(photo, albedo, shading, detail, shoulder=shoulder, toe=toe)
    if highlights is None or not highlights.any():
        return image
    return image.with_pixels(_with_highlights(image, highlights))


def _with_highlights(image: Image, highlights: FloatArray) -> FloatArray:
    """Pixels of the picture with linear light added; sRGB-encoded ones become at most white."""
    if image.encoding == "linear":
        return image.pixels + highlights
    pixels = image.pixels.copy()
    by_strips(lambda rows: with_light(pixels[rows], highlights[rows], encoded=True), pixels.shape)
    return pixels


def with_light(pixels: FloatArray, light: FloatArray, encoded: bool) -> None:
    """Add linear light, n x W x 3, to a part of a picture in place."""
    if not encoded:
        pixels += light
        return
    part = pixels.reshape(-1)
    # Where no light is added the value stays to the last bit.
    places = np.flatnonzero(light.reshape(-1) > 0)
    if len(places):
        few, own = light.reshape(-1).take(places), part.take(places)
        # On bright skin a highlight fades into white instead of burning out: the share of the way to white that it
        # takes on black. A value above white stays.
        before = decode_srgb(own)
        part[places] = np.maximum(encode_srgb(before + np.minimum(few, 1) * np.maximum(1 - before, 0)), own)
