"""Retinex: steep changes are reflectance, gentle ones are shading."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node
from graphface.nodes.intrinsic.logarithm import chromaticity, finite_pixels, log_intensity, separated
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
    """Land and McCann's retinex in its color-gradient form, as a Poisson problem.

    Land, McCann, Lightness and Retinex Theory, JOSA 1971; the color form is that of Grosse et al., Ground Truth
    Dataset and Baseline Evaluations for Intrinsic Image Algorithms, ICCV 2009. A step between neighbours belongs to the
    reflectance where chromaticity changes by more than `color` or log intensity by more than `brightness`; the log
    reflectance is the field whose gradient is nearest to the steps kept.

    Args:
        mask: H x W, over which shading gets the mean of the intensity.
        color, brightness: thresholds on one pixel's step; lower ones move more into the albedo.
        floor: least shading.

    Returns:
        albedo * shading is the photo.
    """
    pixels = finite_pixels(photo, "intrinsic.retinex")
    intensity = log_intensity(pixels)
    steps = gradient(intensity)
    hues = gradient(chromaticity(pixels))
    kept = [_kept(step, hue, color, brightness) for step, hue in zip(steps, hues, strict=True)]
    reflectance = solve(-divergence(kept[0], kept[1]), screen=0)
    return separated(pixels, intensity - reflectance, mask, floor)


def _kept(step: FloatArray, hue: FloatArray, color: float, brightness: float) -> FloatArray:
    """The steps that are changes of reflectance, 0 elsewhere."""
    turned = hue[..., 0] ** 2 + hue[..., 1] ** 2 + hue[..., 2] ** 2 > color**2
    return np.where(turned | (np.abs(step) > brightness), step, np.float32(0))
