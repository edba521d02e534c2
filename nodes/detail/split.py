"""A detail map that is a ratio where light is taken away and a difference where light is added.

A dark residual may be a brow, a crease or a cast shadow, a bright one a highlight or a freckle; a single photo cannot
tell. What matters is whether the light gets less or more. With the shipped graph (`graphface bench lights`;
scale-invariant PSNR in dB on path-traced heads, scale-invariant squared error on photographs of the Yale set):

    source -> target                          additive    ratio     this
    frontal -> six lights                        28.57    29.16    29.12
    left45 -> six lights (--source left45)       25.87    24.20    26.23
    frontal -> eight lights (--truth yale)      0.0101   0.0101   0.0098

Where light is taken away the whole pixel loses it, highlights included, and a difference would leave them glowing: the
ratio is better. Where light is added the ratio multiplies darkness of unknown cause by unbounded factors ("odd-looking
materials", paper, section 5.1): the difference is better. Both are the photo under an unchanged light, so they join
there without a seam.
"""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node, warn
from graphface.nodes.blur import blurred
from graphface.nodes.color import channel_mean, in_three_channels
from graphface.nodes.rendering import bounded_exp, rendering
from graphface.nodes.strips import by_strips
from graphface.nodes.types import Albedo, DetailMap, Image, Landmarks, Shading


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
    """A bounded, regularized ratio for less light than the photo's own, the paper's difference for more.

    With I_e = rho s (paper, equation 3): gain = bounded((I + floor) / (I_e + floor)) of the channel means, one number
    per pixel so that no hue shifts; offset = I - gain I_e; pivot = I_e.

    Args:
        photo: I, in the encoding of albedo and shading.
        shading: s, under the estimated light and spread over the whole picture, H x W or H x W x 3.
        landmarks: give the unit of `cutoff`; without them it is a quarter of the picture's shorter side.
        unclipped: the photo with its highlights reconstructed (`image.unclipped`). It replaces I, and the photo becomes
            the ceiling: a channel that was clipped gets darker only when its reconstructed value falls below the
            photo's.
        bound: the gain stays in 1 / bound .. bound and approaches the ends asymptotically; 1 is the additive map.
        floor: pulls the ratio of dark pixels towards 1.
        cutoff: residuals finer than this, in inter-ocular distances, stay additive; at 0 the ratio takes every scale.

    Returns:
        gain, offset and pivot, and with `unclipped` a ceiling. Recombined under `shading` they return the photo.
    """
    source = photo.pixels if unclipped is None else unclipped.pixels
    rendered, log_ratio = np.empty_like(source), np.empty(source.shape[:2], np.float32)

    def compare(rows: slice) -> None:
        rendered[rows] = rendering(albedo[rows], shading[rows])
        numerator, denominator = (channel_mean(v[rows]) + np.float32(floor) for v in (source, rendered))
        log_ratio[rows] = np.log(np.maximum(numerator, 1e-4) / np.maximum(denominator, 1e-4))

    by_strips(compare, source.shape)
    if cutoff > 0:
        log_ratio = blurred(log_ratio, max(cutoff * _interocular(landmarks, photo), 1e-2))
    gain, offset = np.empty_like(source), np.empty_like(source)

    def divide(rows: slice) -> None:
        gain[rows] = in_three_channels(bounded_exp(log_ratio[rows], bound))
        np.subtract(source[rows], gain[rows] * rendered[rows], out=offset[rows])

    by_strips(divide, source.shape)
    # A copy, because a result that shares memory with a photo of the caller's is not memoized.
    ceiling = None if source is photo.pixels else photo.pixels.copy()
    return DetailMap(offset=offset, gain=gain, pivot=rendered, ceiling=ceiling)


def _interocular(landmarks: Landmarks | None, photo: Image) -> float:
    """Pixels."""
    if landmarks is not None:
        return landmarks.interocular
    warn("detail.split: no landmarks to give the cut-off its unit; took a quarter of the picture's shorter side")
    return min(photo.height, photo.width) / 4
