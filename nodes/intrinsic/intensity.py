"""The paper's intrinsic images: shading is intensity."""

from __future__ import annotations

from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from graphface import node
from graphface.nodes.color import channel_mean
from graphface.nodes.intrinsic.log_domain import finite_pixels
from graphface.nodes.types import FloatArray, Image, Intrinsic, Mask

Intensity = Literal["mean", "luma", "value"]


@node("intrinsic.intensity")
def intensity(
    photo: Image,
    mask: Mask | None = None,
    *,
    measure: Intensity = "mean",
    floor: Annotated[float, Field(gt=0, le=1)] = 0.08,
) -> Intrinsic:
    """s(x) = Intensity(x), rho(x) = I(x) / s(x) (paper, section 3, "Intrinsic images").

    Small dark patches count as shadow. That is wrong for the albedo and right for editing: darkness that is due to
    relief must not be transferred with the color.

    Args:
        photo: I, in any encoding; both maps are in the same one.
        mask: not used; the family has it.
        measure: "mean" of R, G and B; "luma", weighted as in ITU-R BT.709; "value", the largest (then albedo <= 1).
        floor: least shading. Darker pixels get a dark albedo instead, so that the color noise of black is not
            amplified, and black things stay black under any light. The light is fitted to this shading, so a high floor
            takes the shadow side of dark skin for brighter than it is. (Two path-traced heads that nothing was
            learned from, photographed under each of six lights: 0.15 23.5, 0.08 24.0 dB; frontally 27.3 dB with both.
            `graphface bench lights --source`.)

    Returns:
        `albedo` rho, float32 H x W x 3, and `shading` s, float32 H x W; their product is the photo.
    """
    pixels = finite_pixels(photo, "intrinsic.intensity")
    shading = np.maximum(_MEASURES[measure](pixels), np.float32(floor)).astype(np.float32, copy=False)
    return Intrinsic(albedo=pixels / shading[..., None], shading=shading)


def _luma(pixels: FloatArray) -> FloatArray:
    return pixels @ np.array([0.2126, 0.7152, 0.0722], np.float32)


def _value(pixels: FloatArray) -> FloatArray:
    return np.maximum(np.maximum(pixels[..., 0], pixels[..., 1]), pixels[..., 2])


_MEASURES = {"mean": channel_mean, "luma": _luma, "value": _value}
