"""The albedo of the pigment alone: the colors of creases and shine are replaced by that of the skin around them.

The paper's albedo is "large blotches of constant color", and fine relief belongs to the detail map. Where shading is
intensity that does not follow by itself: light between the sides of a crease is reddened and shine is white, so color
over intensity shows both. When the detail of one face is put onto the albedo of another, such colors would remain
without the darkness or the light that they belong to: an orange rim where a nostril was, a grey patch where a cheek
shone. What the albedo loses here the detail map takes up.
"""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node
from graphface.nodes.blur import gaussian
from graphface.nodes.color import channel_mean, in_three_channels
from graphface.nodes.face_scale import face_scale
from graphface.nodes.strips import by_strips
from graphface.nodes.types import Albedo, FloatArray, Landmarks, Mask, Shading

_FLOOR = np.float32(0.02)
"""Added to intensities before they are divided."""


_LEAST_WEIGHT = np.float32(1e-3)


_FAR, _FAR_WEIGHT = 4, np.float32(0.05)
"""A second average, so many times as wide, and its weight: it decides where nothing near is reliable."""


@node("makeup.pigment")
def pigment(
    albedo: Albedo,
    shading: Shading,
    estimated: Shading,
    skin: Mask,
    landmarks: Landmarks,
    *,
    dark: Annotated[float, Field(gt=0, le=1)] = 0.85,
    bright: Annotated[float, Field(ge=1, le=10)] = 1.1,
    reach: Annotated[float, Field(gt=0, le=1)] = 0.08,
    resolution: Annotated[int, Field(ge=8, le=256)] = 64,
) -> Albedo:
    """The albedo, in creases and shine replaced by the average over the reliable skin around.

    Args:
        albedo, shading: of an intrinsic method. estimated: SH(n, l), the estimated light's shading over the picture.
        skin: where colors around are averaged.
        dark: ratio of intensity to its local mean below which a pixel begins to be a crease; at half of it, it is one.
        bright: ratio of intensity to the estimated shading above which a pixel begins to shine; at 1.5 times that it
            does.
        reach: sigma of the Gaussian average, in inter-ocular distances; lips and painted stripes are broader.
        resolution: pixels per inter-ocular distance of the copy on which averages are computed.
    """
    copy = face_scale(landmarks, albedo.shape, resolution)
    sigma = reach * copy.interocular
    light = channel_mean(estimated)
    intensity = copy.down(channel_mean(shading))
    local_mean = gaussian(intensity, 1.5 * sigma)
    reliability = _reliability(intensity, local_mean, copy.down(light), dark, bright)
    weight = (np.square(reliability) + _LEAST_WEIGHT) * (copy.down(skin) + _LEAST_WEIGHT)
    weighted = np.dstack([copy.down(albedo) * weight[..., None], weight])
    sums = gaussian(weighted, sigma) + _FAR_WEIGHT * gaussian(weighted, _FAR * sigma)
    around = copy.up(np.asarray(sums[..., :3] / np.maximum(sums[..., 3:], np.float32(1e-9)), np.float32))
    local_mean = copy.up(local_mean)
    result = np.empty_like(albedo)

    def strip(rows: slice) -> None:
        own = _reliability(channel_mean(shading[rows]), local_mean[rows], light[rows], dark, bright)
        result[rows] = around[rows] + in_three_channels(own) * (albedo[rows] - around[rows])

    by_strips(strip, albedo.shape)
    return result


def _reliability(
    intensity: FloatArray, local_mean: FloatArray, light: FloatArray, dark: float, bright: float
) -> FloatArray:
    """1 where the color is the pigment's, falling to 0 in the depth of a crease and in full shine."""
    crease = (intensity + _FLOOR) / (local_mean + _FLOOR) * np.float32(2 / dark) - 1
    shine = 3 - (intensity + _FLOOR) / (light + _FLOOR) * np.float32(2 / bright)
    return np.asarray(np.clip(np.minimum(crease, shine), 0, 1), np.float32)
