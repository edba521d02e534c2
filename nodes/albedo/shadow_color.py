"""The color of what is dark: no more saturated than the same skin where it is lit.

Cameras, and people who edit photos, bend tones with a curve, which makes dark pixels more saturated than bright ones of
the same material; and in creases light is reddened by the skin that it bounced off. Both are true of the photo and
false of the albedo: light added to such a pixel in its own color makes it glow orange, where the skin would just look
lit. The photo itself is not touched: what the albedo loses here the detail map takes up.
"""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node
from graphface.nodes.blur import blurred
from graphface.nodes.color import channel_mean, in_three_channels
from graphface.nodes.face_scale import face_scale
from graphface.nodes.strips import by_strips
from graphface.nodes.types import Albedo, FloatArray, Image, Landmarks, Mask

_LEAST = np.float32(1e-3)


@node("albedo.shadow_colour")
def shadow_colour(
    albedo: Albedo,
    photo: Image,
    mask: Mask,
    landmarks: Landmarks,
    *,
    dark: Annotated[float, Field(gt=0, le=1)] = 0.8,
    reach: Annotated[float, Field(gt=0, le=5)] = 0.3,
    resolution: Annotated[int, Field(ge=8, le=256)] = 24,
) -> Albedo:
    """An albedo whose dark pixels are at most as saturated as the lit skin around them; brightness and hue stay.

    Args:
        albedo: of an intrinsic method.
        photo: what it was made of.
        mask: the face, where skin is looked for.
        dark: below this share of the usual brightness around, the limit begins to count; at half of it it counts fully.
        reach: of what is around, in inter-ocular distances.
        resolution: pixels per inter-ocular distance of the copy on which averages are taken.
    """
    copy = face_scale(landmarks, albedo.shape, resolution)
    sigma = max(reach * copy.interocular, 0.5)
    seen = copy.down(mask) + _LEAST
    light, pure = _mean_and_saturation(copy.down(photo.pixels))
    weight = seen * np.square(light) + np.float32(1e-9)
    sums = blurred(np.dstack([weight, weight * light, weight * pure]), sigma)
    usual, limit = (copy.up(sums[..., n] / sums[..., 0]) for n in (1, 2))
    result = np.empty_like(albedo)

    def strip(rows: slice) -> None:
        grey, own = _mean_and_saturation(albedo[rows])
        share = _mean_and_saturation(photo.pixels[rows])[0]
        share /= np.maximum(usual[rows], _LEAST)
        share *= np.float32(-2 / dark)
        share += 2
        np.clip(share, 0, 1, out=share)
        # own - share * max(own - limit, 0), as a factor of own
        over = np.maximum(own - limit[rows], 0)
        over *= share
        over /= np.maximum(own, _LEAST)
        middle = in_three_channels(grey)
        result[rows] = middle + in_three_channels(1 - over) * (albedo[rows] - middle)

    by_strips(strip, result.shape)
    return result


def _mean_and_saturation(pixels: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Mean of the channels, and how far the least lies below it as a share of it: 0 for grey, 1 for a pure color."""
    mean = channel_mean(pixels)
    least = np.minimum(np.minimum(pixels[..., 0], pixels[..., 1]), pixels[..., 2])
    return mean, np.maximum(1 - least / np.maximum(mean, _LEAST), 0)
