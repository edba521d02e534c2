"""The relit picture: what the scene calls for put together, and the photo itself where it calls for nothing."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import Lazy, Needs, UsageError, node
from graphface.nodes.color import decode_srgb, encode_srgb
from graphface.nodes.rendering import recombined
from graphface.nodes.strips import by_strips
from graphface.nodes.types import Albedo, DetailMap, Image, Scene, Shading


def _wanted(scene: Scene) -> Needs:
    if scene.unchanged:
        same = "the scene is the photo's own light: nothing changes"
        return {"albedo": same, "shading": same, "detail": same, "highlights": same}
    dull = "the scene asks for no highlights (specular: 0)"
    return {"albedo": True, "shading": True, "detail": True, "highlights": scene.specular > 0 or dull}


@node("render.relit", needs=_wanted)
def relit(
    photo: Image,
    scene: Scene,
    albedo: Lazy[Albedo] = None,
    shading: Lazy[Shading] = None,
    detail: Lazy[DetailMap] = None,
    highlights: Lazy[Shading] = None,
    *,
    shoulder: Annotated[float, Field(ge=0, le=1)] = 0.5,
) -> Image:
    """Albedo times shading plus detail (`blend.recombine`), plus highlights; the photo where the scene changes nothing.

    Args:
        photo: the picture before, in the encoding of the others.
        highlights: linear light to add, H x W x 3.
        shoulder: see `blend.recombine`.
    """
    if scene.unchanged:
        return photo
    if albedo is None or shading is None or detail is None:
        raise UsageError("render.relit needs albedo, shading and detail unless the scene leaves the photo as it is")
    image = recombined(photo, albedo, shading, detail, shoulder=shoulder)
    if highlights is None or not highlights.any():
        return image
    if photo.encoding == "linear":
        return image.with_pixels(image.pixels + highlights)
    pixels = np.empty_like(image.pixels)

    def strip(rows: slice) -> None:
        part, light = image.pixels[rows], highlights[rows]
        if light.any():
            # At most white, or as bright as it was; where no light is added encoding may not even round.
            brighter = np.minimum(encode_srgb(decode_srgb(part) + light), np.maximum(part, 1))
            part = np.where(light > 0, brighter, part)
        pixels[rows] = part

    by_strips(strip, pixels.shape)
    return image.with_pixels(pixels)
