"""The albedo as paint has it: the redness of creases and the paleness of shine given back to the detail map.

The paper's albedo is "large blotches of constant color", and fine relief is left to the detail map. Where shading is
intensity that does not come by itself: light that is caught in a crease is reddened, and shine is white, so color over
intensity shows both. When detail of one face is put onto the albedo of another, such colors would stay behind without
the darkness or the light that they belong to: an orange rim where a nostril was, a grey patch where a cheek shone.
"""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node
from graphface.nodes.color import channel_mean
from graphface.nodes.face_scale import face_scale
from graphface.nodes.strips import by_strips
from graphface.nodes.types import Albedo, FloatArray, Landmarks, Mask, Shading

_LEAST_LIGHT = 0.02


_LEAST_TRUST = np.float32(1e-3)


_FAR = 0.05
"""Weight of the wide average beside the near one: it decides where the near one has seen nothing to be trusted."""


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
    """The albedo, in creases and shine that of the skin around them.

    Args:
        albedo, shading: of an intrinsic method. estimated: the light's shading, spread over the picture.
        skin: where colors around are taken from.
        dark: how much darker than its surroundings, as a factor, a pixel begins to be a crease; at half of that it is
            one. bright: how much brighter than the estimated light it begins to shine; at half as much again it does.
        reach: of the average around, in inter-ocular distances; lips and stripes are broader.
        resolution: pixels per inter-ocular distance of the copy on which averages are taken.
    """
    import cv2

    copy = face_scale(landmarks, albedo.shape, resolution)
    unit = copy.interocular
    light = channel_mean(estimated)
    brightness, lit, color = copy.down(channel_mean(shading)), copy.down(light), copy.down(albedo)
    usual = _smooth(brightness, 1.5 * reach * unit)
    weight = (np.square(_trusted(brightness, usual, lit, dark, bright)) + _LEAST_TRUST) * (
        copy.down(skin) + _LEAST_TRUST
    )
    near, far = (_smooth(np.dstack([color * weight[..., None], weight]), r * reach * unit) for r in (1, 4))
    mean = near + np.float32(_FAR) * far
    around = copy.up(np.asarray(mean[..., :3] / np.maximum(mean[..., 3:], np.float32(1e-9)), np.float32))
    usual = copy.up(usual)
    steady = np.empty_like(albedo)

    def strip(rows: slice) -> None:
        trust = _trusted(channel_mean(shading[rows]), usual[rows], light[rows], dark, bright)
        steady[rows] = around[rows] + cv2.cvtColor(trust, cv2.COLOR_GRAY2RGB) * (albedo[rows] - around[rows])

    by_strips(strip, albedo.shape)
    return steady


def _trusted(brightness: FloatArray, usual: FloatArray, light: FloatArray, dark: float, bright: float) -> FloatArray:
    """1 where a pixel's color is its pigment's, 0 in the depth of a crease and in full shine."""
    least = np.float32(_LEAST_LIGHT)
    crease = (brightness + least) / (usual + least) * np.float32(2 / dark) - 1
    shine = 3 - (brightness + least) / (light + least) * np.float32(2 / bright)
    return np.asarray(np.clip(np.minimum(crease, shine), 0, 1), np.float32)


def _smooth(values: FloatArray, sigma: float) -> FloatArray:
    import cv2

    return np.asarray(cv2.GaussianBlur(values, (0, 0), max(sigma, 0.5), borderType=cv2.BORDER_REPLICATE), np.float32)
