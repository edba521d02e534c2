"""The color of dark skin: no more saturated than the same skin where it is lit.

The tone curves of cameras and editors make dark pixels more saturated than bright ones of the same material, and in
creases light is reddened by the skin that it was reflected from. Both belong to the photo and not to the albedo: light
added to such a pixel in its own color would make it glow orange. The photo itself does not change, because the detail
map takes up what the albedo loses.
"""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import Formerly, node
from graphface.nodes.blur import blurred
from graphface.nodes.color import channel_mean, in_three_channels
from graphface.nodes.face_scale import face_scale
from graphface.nodes.strips import by_strips
from graphface.nodes.types import Albedo, FloatArray, Image, Landmarks, Mask

_LEAST = np.float32(1e-3)


@node("albedo.shadow_color", formerly=("albedo.shadow_colour",))
def shadow_color(
    albedo: Albedo,
    photo: Image,
    mask: Mask,
    landmarks: Landmarks,
    *,
    threshold: Annotated[float, Field(gt=0, le=1), Formerly("dark")] = 0.8,
    sigma: Annotated[float, Field(gt=0, le=5), Formerly("reach")] = 0.3,
    resolution: Annotated[int, Field(ge=8, le=256)] = 24,
) -> Albedo:
    """Limit the saturation of an albedo at dark pixels to that of the lit skin around; brightness and hue stay.

    Args:
        albedo: of an intrinsic method, H x W x 3.
        photo: the picture that it was computed from.
        mask: the face, H x W; the averages are taken over it.
        threshold: share of the mean brightness around below which the limit begins to apply; at half of it, it applies
            in full.
        sigma: standard deviation of the averages, in inter-ocular distances.
        resolution: pixels per inter-ocular distance of the copy on which averages are taken.
    """
    copy = face_scale(landmarks, albedo.shape, resolution)
    width = max(sigma * copy.interocular, 0.5)
    in_face = copy.down(mask) + _LEAST
    brightness, saturation = _mean_and_saturation(copy.down(photo.pixels))
    weight = in_face * np.square(brightness) + np.float32(1e-9)
    sums = blurred(np.dstack([weight, weight * brightness, weight * saturation]), width)
    mean_around, limit = (copy.up(sums[..., n] / sums[..., 0]) for n in (1, 2))
    result = np.empty_like(albedo)

    def strip(rows: slice) -> None:
        grey, own = _mean_and_saturation(albedo[rows])
        share = _mean_and_saturation(photo.pixels[rows])[0]
        share /= np.maximum(mean_around[rows], _LEAST)
        share *= np.float32(-2 / threshold)
        share += 2
        np.clip(share, 0, 1, out=share)
        # own - share * max(own - limit, 0), as a factor of own
        reduction = np.maximum(own - limit[rows], 0)
        reduction *= share
        reduction /= np.maximum(own, _LEAST)
        mean = in_three_channels(grey)
        result[rows] = mean + in_three_channels(1 - reduction) * (albedo[rows] - mean)

    by_strips(strip, result.shape)
    return result


def _mean_and_saturation(pixels: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Intensity I and saturation S = 1 - min(R, G, B) / I of the HSI color model, H x W each: S is 0 for grey."""
    mean = channel_mean(pixels)
    least = np.minimum(np.minimum(pixels[..., 0], pixels[..., 1]), pixels[..., 2])
    return mean, np.maximum(1 - least / np.maximum(mean, _LEAST), 0)
