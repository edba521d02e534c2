"""Retinex: large steps between neighbouring pixels are reflectance, small ones are shading."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node
from graphface.nodes.intrinsic.log_domain import chromaticity, finite_pixels, intrinsic_images, log_intensity
from graphface.nodes.intrinsic.poisson import divergence, gradient, solve
from graphface.nodes.types import FloatArray, Image, Intrinsic, Mask

Threshold = Annotated[float, Field(gt=0, le=10)]


@node("intrinsic.retinex")
def retinex(
    photo: Image,
    mask: Mask | None = None,
    *,
    color: Threshold = 0.02,
    brightness: Threshold = 0.25,
    floor: Annotated[float, Field(gt=0, le=1)] = 0.05,
) -> Intrinsic:
    """Color retinex as a Poisson problem.

    Land, McCann, Lightness and Retinex Theory, JOSA 1971, in the color form of Grosse, Johnson, Adelson, Freeman,
    Ground Truth Dataset and Baseline Evaluations for Intrinsic Image Algorithms, ICCV 2009. A step between neighbours
    is reflectance where chromaticity changes by more than `color` or log intensity by more than `brightness`. The log
    reflectance is the field whose gradient is nearest to these steps in the least-squares sense.

    Args:
        mask: H x W; over it shading gets the mean of the intensity.
        color, brightness: thresholds of the step between two pixels; lower ones leave more in the albedo.
        floor: least shading.

    Returns:
        albedo * shading is the photo.
    """
    pixels = finite_pixels(photo, "intrinsic.retinex")
    intensity = log_intensity(pixels)
    steps = zip(gradient(intensity), gradient(chromaticity(pixels)), strict=True)
    kept = [_reflectance_steps(step, chroma_step, color, brightness) for step, chroma_step in steps]
    reflectance = solve(-divergence(kept[0], kept[1]), screen=0)
    return intrinsic_images(pixels, intensity - reflectance, mask, floor)


def _reflectance_steps(step: FloatArray, chroma_step: FloatArray, color: float, brightness: float) -> FloatArray:
    """The steps of log intensity that are changes of reflectance, 0 elsewhere: H x W."""
    squared = chroma_step[..., 0] ** 2 + chroma_step[..., 1] ** 2 + chroma_step[..., 2] ** 2
    return np.where((squared > color**2) | (np.abs(step) > brightness), step, np.float32(0))
