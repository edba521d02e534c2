"""The relit picture at the photo's own size."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from graphface import Lazy, Needs, UsageError, node
from graphface.nodes.color import decode_srgb, encode_srgb
from graphface.nodes.enlargement import Enlarged
from graphface.nodes.render.composite import share_of_new
from graphface.nodes.render.pixelwise import EnlargedPixelwise, Layers, Pixelwise
from graphface.nodes.strips import by_strips, in_parallel
from graphface.nodes.types import (
    Albedo,
    DetailMap,
    Encoding,
    FloatArray,
    Image,
    Landmarks,
    Mask,
    Scene,
    Segmentation,
    Shading,
)

_LEAST_REST = 1e-3
"""Largest difference between two pictures that are the same to the eye and to an 8-bit file."""


_PROBES, _PROBED = 8, 8
"""Places of the small picture at which the model is compared with the graph, and their rows."""

_PLANES = 16
"""Maps of a pixel that are at hand together, for the size of a strip."""


def _needs(scene: Scene) -> Needs:
    names = ("working", "relit", "landmarks", "albedo", "detail", "estimated", "spread", "labels", "response")
    far = "no lamp of the scene is near, or it lights no background"
    if scene.unchanged:
        same = "the scene is the photo's own light: nothing changes"
        return dict.fromkeys((*names, "wall", "shine", "lamps", "highlights"), same)
    return {
        **dict.fromkeys(names, True),
        "wall": (scene.background > 0 and scene.local) or far,
        "shine": scene.hair != 0 or "the scene lights hair like the face (hair: 0)",
        "lamps": scene.background > 0 or "the scene does not light the background (background: 0)",
        "highlights": scene.glossy or "the scene has no light that makes highlights, or asks for none (specular: 0)",
    }


@node("render.full_size", needs=_needs)
def full_size(
    photo: Image,
    scene: Scene,
    working: Lazy[Image] = None,
    relit: Lazy[Image] = None,
    landmarks: Lazy[Landmarks] = None,
    albedo: Lazy[Albedo] = None,
    detail: Lazy[DetailMap] = None,
    estimated: Lazy[Shading] = None,
    spread: Lazy[Shading] = None,
    wall: Lazy[Shading] = None,
    labels: Lazy[Segmentation] = None,
    response: Lazy[Mask] = None,
    shine: Lazy[Mask] = None,
    lamps: Lazy[Mask] = None,
    highlights: Lazy[Shading] = None,
) -> Image:
    """The photo relit at its own size, from the result at the working size and what it was made of.

    Shading and the colors of the albedo are smooth and are enlarged. Masks are carried along the photo's edges by local
    linear functions of color (He and Sun, Fast Guided Filter, 2015). Every pixel is then relit by the formulas of the
    shipped graph (`graphface.nodes.render.pixelwise`), a few rows at a time, and nothing else is kept at the photo's
    size. Where those formulas give another picture at the working size than the graph, because a method of it was
    replaced, the difference is enlarged and added.

    Args:
        photo: any size and encoding; a picture of the working size has nothing to be carried.
        working, relit: the photo at the working size, before and after.
        landmarks, albedo, detail, wall, response, shine, lamps, highlights: at the working size, as in
            `render.composite` and `render.relit`.
        estimated, spread: shading of the whole picture under the photo's own and the new light, before it is blended by
            label.

    Returns:
        The picture in the encoding of `working`; the photo itself under its own light.

    Raises:
        UsageError: the scene changes the light, and something is missing.
    """
    if scene.unchanged:
        return photo
    if working is not None and relit is not None and working.pixels.shape == photo.pixels.shape:
        return relit
    parts = {
        "working": working,
        "relit": relit,
        "landmarks": landmarks,
        "albedo": albedo,
        "detail": detail,
        "estimated": estimated,
        "spread": spread,
        "labels": labels,
        "response": response,
    }
    missing = [name for name, part in parts.items() if part is None]
    if missing:
        raise UsageError(f"render.full_size lacks {', '.join(missing)}, of which the relit picture was made")
    return _carried(photo, scene, parts, {"wall": wall, "shine": shine, "lamps": lamps, "highlights": highlights})


def _carried(photo: Image, scene: Scene, parts: Mapping[str, Any], others: Mapping[str, Any]) -> Image:
    """The photo relit as its small copy is: `parts` are there, each of `others` may be None."""
    working, labels, wall = parts["working"], parts["labels"], others["wall"]
    masks = (labels if scene.background != 1 else None, others["shine"], others["lamps"])
    pixelwise = Pixelwise(
        Layers(
            pixels=working.pixels,
            landmarks=parts["landmarks"],
            albedo=parts["albedo"],
            detail=parts["detail"],
            before=parts["estimated"],
            after=parts["spread"],
            wall=wall,
            background=labels.background,
            share=share_of_new(scene, *masks) if any(mask is not None for mask in masks) else None,
            face=labels.face,
            response=parts["response"],
            highlights=others["highlights"],
            encoded=working.encoding == "srgb",
        )
    )
    size = photo.pixels.shape[:2]
    model = pixelwise.at(size)
    rest = _rest(pixelwise.at(working.pixels.shape[:2]), working, parts["relit"])
    enlarged = None if rest is None else Enlarged([rest[..., channel] for channel in range(3)], size)
    pixels = np.empty(photo.pixels.shape, np.float32)

    def strip(rows: slice) -> None:
        before = _encoded(photo.pixels[rows], photo.encoding, working.encoding)
        part = model.rows(rows, before)
        if enlarged is not None:
            for channel, plane in enumerate(enlarged.rows(rows)):
                part[..., channel] += plane
            np.maximum(part, np.minimum(before, 0), out=part)
            np.minimum(part, np.maximum(before, 1), out=part)
        pixels[rows] = part

    by_strips(strip, (*size, _PLANES))
    return photo.with_pixels(pixels, working.encoding)


def _rest(model: EnlargedPixelwise, working: Image, relit: Image) -> FloatArray | None:
    """What the graph's picture is beyond the model's, h x w x 3, or None where that is nothing in a few rows."""
    rest = np.empty_like(working.pixels)

    def strip(rows: slice) -> None:
        np.subtract(relit.pixels[rows], model.rows(rows, working.pixels[rows]), out=rest[rows])

    height = len(rest)
    tops = range(0, height, max(1, height // _PROBES))
    probes = [slice(top, min(top + _PROBED, height)) for top in tops]
    in_parallel(strip, probes)
    if all(np.abs(rest[probe]).max(initial=0) <= _LEAST_REST for probe in probes):
        return None
    by_strips(strip, (*rest.shape[:2], _PLANES))
    return rest


def _encoded(pixels: FloatArray, own: Encoding, wanted: Encoding) -> FloatArray:
    if own == wanted:
        return pixels
    return encode_srgb(pixels) if wanted == "srgb" else decode_srgb(pixels)
