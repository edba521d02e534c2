"""What a pixel is told by: its color, and the texture around it."""

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
"""Responses are this many times amplified, then compressed by asinh: a strand counts, a hard edge not for ever more."""


TEXTURE_WEIGHTS = (0.02, 0.02, 0.01, 0.01, 0.005, 0.005, 0.005, 0.005)
"""Scales of the eight responses beside color: the wider a filter reaches, the less it says about this very pixel.

Mixtures have a least width, so a small scale blurs small differences. Just beside a head wide filters see the head, and
with large weights those pixels looked like anything but the flat backdrop that they are.
"""


@dataclass(frozen=True)
class PixelFeatures:
    """Features `values`, float32 h x w x D, of the part of a photo that `window` names."""

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
        photo: of either encoding; its values are compared as they are.
        landmarks: where to look.
        resolution: pixels per inter-ocular distance that features are computed at; small faces keep their own size.
        space, kind, bank: see `features`.
    """
    window = window_about(landmarks, photo.pixels.shape, resolution)
    return PixelFeatures(window, features(window.shrunk(photo.pixels), space=space, kind=kind, bank=bank))


def features(
    pixels: FloatArray, *, space: ColorSpace = "lab", kind: FeatureSet = "color+mr8", bank: Bank = "pyramid"
) -> FloatArray:
    """One vector a pixel, float32 H x W x 3 or H x W x 11, of comparable ranges.

    Args:
        pixels: H x W x 3 sRGB-encoded; values beyond [0, 1] are clipped, non-finite ones become 0.
        space: where colors are compared. kind: color alone, or with the MR8 responses of the lightness.
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
