"""The paper's own split of a picture: shading is intensity."""

from __future__ import annotations

from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from graphface import node
from graphface.nodes.color import channel_mean
from graphface.nodes.intrinsic.logarithm import finite_pixels
from graphface.nodes.types import FloatArray, Image, Intrinsic, Mask

Intensity = Literal["mean", "luma", "value"]


@node("intrinsic.intensity")
def intensity(
    photo: Image,
    mask: Mask | None = None,
    *,
    measure: Intensity = "mean",
    floor: Annotated[float, Field(gt=0, le=1)] = 0.15,
) -> Intrinsic:
    """s(x) = intensity of I(x), rho(x) = I(x) / s(x) (paper, section 2, "Intrinsic images").

    It takes small dark patches for shadow. That is wrong for the albedo and right for editing: what is dark because of
    relief must not travel with the color.

    Args:
        photo: in any encoding; both maps are in the same one.
        mask: takes no part; the family has it.
        measure: "mean" of R, G and B; "luma", their Rec. 709 weighting; "value", the largest (then albedo <= 1).
        floor: the least shading. Pixels darker than it get a dark albedo instead, so that the color noise of black is
            not blown up, and black things stay black under any light.

    Returns:
        `albedo` float32 H x W x 3, `shading` float32 H x W; their product is the photo.
    """
    pixels = finite_pixels(photo, "intrinsic.intensity")
    shading = np.maximum(_MEASURES[measure](pixels), np.float32(floor)).astype(np.float32, copy=False)
    return Intrinsic(albedo=pixels / shading[..., None], shading=shading)


def _luma(pixels: FloatArray) -> FloatArray:
    return pixels @ np.array([0.2126, 0.7152, 0.0722], np.float32)


def _value(pixels: FloatArray) -> FloatArray:
    return np.maximum(np.maximum(pixels[..., 0], pixels[..., 1]), pixels[..., 2])


_MEASURES = {"mean": channel_mean, "luma": _luma, "value": _value}
