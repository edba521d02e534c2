"""Features of pixels: their color, and the texture around them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from graphface import node
from graphface.nodes.color import ColorSpace, in_space
from graphface.nodes.masks.texture import Bank, mr8
from graphface.nodes.masks.window import Window, window_about
from graphface.nodes.types import FloatArray, Image, Landmarks

FeatureSet = Literal["color", "color+mr8"]


TEXTURE_GAIN = 8.0
"""Filter responses are amplified by this and compressed by asinh: strands count, and hard edges do not dominate."""


TEXTURE_WEIGHTS = (0.02, 0.02, 0.01, 0.01, 0.005, 0.005, 0.005, 0.005)
"""Scales of the eight responses beside color. The wider a filter, the less it says about the pixel itself.

Mixtures have a least standard deviation, so a small scale blurs small differences. Wide filters next to a head respond
to the head. With large weights those pixels looked unlike the flat backdrop that they show.
"""


@dataclass(frozen=True)
class PixelFeatures:
    """Features `values`, float32 h x w x D, of the `window` of a photo."""

    window: Window
    values: FloatArray


@node("masks.features")
def pixel_features(
    photo: Image,
    landmarks: Landmarks,
    *,
    resolution: Annotated[int, Field(ge=8, le=512)] = 40,
    space: ColorSpace = "lab",
    kind: FeatureSet = "color+mr8",
    bank: Bank = "pyramid",
) -> PixelFeatures:
    """Color and texture around a face.

    Args:
        photo: of either encoding; its values are used as they are.
        landmarks: place the window.
        resolution: pixels per inter-ocular distance at which features are computed; small faces keep their own size.
        space, kind, bank: see `features`.
    """
    window = window_about(landmarks, photo.pixels.shape, resolution)
    return PixelFeatures(window, features(window.downsampled(photo.pixels), space=space, kind=kind, bank=bank))


def features(
    pixels: FloatArray, *, space: ColorSpace = "lab", kind: FeatureSet = "color+mr8", bank: Bank = "pyramid"
) -> FloatArray:
    """One vector per pixel, float32 H x W x 3 or H x W x 11, of comparable ranges.

    Args:
        pixels: H x W x 3 sRGB-encoded; values beyond [0, 1] are clipped, NaN becomes 0.
        space: color space. kind: color alone, or with the MR8 responses of the lightness.
        bank: see `masks.texture.mr8`.
    """
    import cv2

    clean = np.clip(np.nan_to_num(pixels, nan=0, posinf=1, neginf=0), 0, 1).astype(np.float32, copy=False)
    color = in_space(clean, space)
    if kind == "color":
        return color
    grey = np.asarray(cv2.cvtColor(clean, cv2.COLOR_RGB2GRAY), np.float32)
    texture = np.arcsinh(TEXTURE_GAIN * mr8(grey, bank)) * np.asarray(TEXTURE_WEIGHTS, np.float32)
    return np.concatenate([color, texture], axis=2, dtype=np.float32)
