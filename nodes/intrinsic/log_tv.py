"""Logarithmic total variation: shading is the cartoon of large-scale structures."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node
from graphface.nodes.intrinsic.guided_upsampling import reduced, upsampled
from graphface.nodes.intrinsic.log_domain import finite_pixels, intrinsic_images, log_intensity
from graphface.nodes.intrinsic.poisson import divergence, gradient
from graphface.nodes.types import FloatArray, Image, Intrinsic, Mask


@node("intrinsic.log_tv")
def log_tv(
    photo: Image,
    mask: Mask | None = None,
    *,
    scale: Annotated[float, Field(gt=0, le=1)] = 0.04,
    iterations: Annotated[int, Field(ge=1, le=2000)] = 150,
    resolution: Annotated[int, Field(ge=16, le=8192)] = 320,
    floor: Annotated[float, Field(gt=0, le=1)] = 0.05,
) -> Intrinsic:
    """log s = argmin_u sum |grad u| + lambda sum |log I - u|, the TV-L1 model of the log intensity.

    Chen, Yin, Zhou, Comaniciu, Huang, Total Variation Models for Variable Lighting Face Recognition, TPAMI 2006; used
    for relighting by Li et al. (cited in the paper). TV-L1 separates by size, not by contrast: structures narrower than
    2 / lambda are not in u, however dark they are.

    Args:
        mask: H x W; over it shading gets the mean of the intensity.
        scale: radius of the structures that are albedo, as a share of the longer side; lambda = 2 / radius.
        iterations: of the primal-dual method.
        resolution: longer side in pixels of the copy on which the problem is solved.
        floor: least shading.

    Returns:
        albedo * shading is the photo.
    """
    pixels = finite_pixels(photo, "intrinsic.log_tv")
    intensity = log_intensity(pixels)
    small = log_intensity(reduced(pixels, resolution))
    weight = 2 / max(scale * max(small.shape), 1.0)
    cartoon = _tv_l1(small, weight, iterations)
    return intrinsic_images(pixels, upsampled(cartoon, small, intensity), mask, floor)


def _tv_l1(values: FloatArray, weight: float, iterations: int) -> FloatArray:
    """argmin_u sum |grad u| + weight sum |values - u|: Chambolle and Pock, JMIV 2011, algorithm 1 and section 6.2.

    Primal u, its extrapolation u_bar, dual p = (down, across), and sigma = tau = `step`.
    """
    step = np.float32(1 / np.sqrt(8))  # sigma tau |grad|^2 <= 1, the condition of convergence, with |grad|^2 <= 8
    u, u_bar = values.copy(), values
    down, across = np.zeros_like(values), np.zeros_like(values)
    for _ in range(iterations):
        rise, run = gradient(u_bar)
        down += step * rise
        across += step * run
        length = np.maximum(np.sqrt(down * down + across * across), 1)
        down /= length
        across /= length
        difference = u + step * divergence(down, across) - values
        threshold = step * np.float32(weight)
        updated = values + np.sign(difference) * np.maximum(np.abs(difference) - threshold, 0)
        u_bar, u = 2 * updated - u, updated
    return u
