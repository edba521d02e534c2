"""A detail map that is a ratio where the light falls and a difference where it rises.

A dark residual may be a brow, a crease or a cast shadow, a bright one a highlight or a freckle; a single photo does not
say which. What matters is which way the light goes, measured with the shipped graph (`graphface bench lights`;
scale-invariant PSNR in dB on path-traced heads, scale-invariant squared error on photographs of the Yale set):

    source -> target                          additive    ratio     this
    frontal -> six lights                        28.27    28.86    28.89
    left45 -> six lights (--source left45)       25.81    24.62    26.34
    frontal -> eight lights (--truth yale)      0.0137   0.0119   0.0116

Where light is taken away everything in the pixel loses it, highlights included, and a difference leaves them glowing:
the ratio wins. Where light is added the ratio multiplies darkness whose cause is unknown, by factors without bound (the
paper's "odd-looking materials ... where the ratio is large or small"): the difference wins. Both are the photo when the
light is unchanged, so joining them there makes no seam.
"""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node, warn
from graphface.nodes.blur import blurred
from graphface.nodes.color import channel_mean, in_three_channels
from graphface.nodes.rendering import rendering
from graphface.nodes.strips import by_strips
from graphface.nodes.types import Albedo, DetailMap, FloatArray, Image, Landmarks, Shading


@node("detail.split")
def split(
    photo: Image,
    albedo: Albedo,
    shading: Shading,
    landmarks: Landmarks | None = None,
    unclipped: Image | None = None,
    *,
    bound: Annotated[float, Field(ge=1, le=20)] = 2.0,
    floor: Annotated[float, Field(gt=0, le=1)] = 0.05,
    cutoff: Annotated[float, Field(ge=0, le=2)] = 0.0,
) -> DetailMap:
    """A bounded, regularised ratio below the photo's own light, the paper's difference above it.

    With R = rho s the rendering under the estimated light, gain = bounded((I + floor) / (R + floor)), one number per
    pixel so that no hue shifts, and offset = I - gain R.

    Args:
        photo: in the encoding that albedo and shading were made in.
        shading: the estimated light's, H x W or H x W x 3, spread over the whole picture.
        landmarks: gives the unit of `cutoff`; without them it is a quarter of the picture's shorter side.
        unclipped: the photo with its highlights reconstructed (`image.unclipped`). Light is taken away from it instead
            of from the photo, so that a channel that was clipped falls only once it is below what the photo shows.
        bound: the gain stays within 1 / bound .. bound, approached softly; 1 is the additive map.
        floor: draws the ratio of dark pixels towards 1.
        cutoff: residual finer than this, in inter-ocular distances, is left additive; 0: the ratio takes every scale.

    Returns:
        gain, offset, pivot, and a ceiling with `unclipped`; recombined under `shading` they return the photo.
    """
    source = photo.pixels if unclipped is None else unclipped.pixels
    rendered, ratio = np.empty_like(source), np.empty(source.shape[:2], np.float32)

    def compare(rows: slice) -> None:
        rendered[rows] = rendering(albedo[rows], shading[rows])
        above, below = (channel_mean(v[rows]) + np.float32(floor) for v in (source, rendered))
        ratio[rows] = np.log(np.maximum(above, 1e-4) / np.maximum(below, 1e-4))

    by_strips(compare, source.shape)
    if cutoff > 0:
        ratio = blurred(ratio, max(cutoff * _unit(landmarks, photo), 1e-2))
    gain, offset = np.empty_like(source), np.empty_like(source)

    def part(rows: slice) -> None:
        gain[rows] = in_three_channels(_bounded(ratio[rows], bound))
        np.subtract(source[rows], gain[rows] * rendered[rows], out=offset[rows])

    by_strips(part, source.shape)
    # A copy: what shares memory with a photo that the caller owns is not remembered.
    ceiling = None if source is photo.pixels else photo.pixels.copy()
    return DetailMap(offset=offset, gain=gain, pivot=rendered, ceiling=ceiling)


def _bounded(ratio: FloatArray, bound: float) -> FloatArray:
    """exp of a log ratio, squeezed so that it nears `bound` and its inverse without a kink."""
    limit = np.float32(max(np.log(bound), 1e-6))
    gain: FloatArray = np.exp(limit * np.tanh(ratio / limit))
    return gain


def _unit(landmarks: Landmarks | None, photo: Image) -> float:
    if landmarks is not None:
        return landmarks.interocular
    warn("detail.split: no landmarks to give the cut-off its unit; took a quarter of the picture's shorter side")
    return min(photo.height, photo.width) / 4
