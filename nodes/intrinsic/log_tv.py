"""Logarithmic total variation: shading is the large-scale part that a cartoon keeps."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node
from graphface.nodes.intrinsic.lift import lifted, shrunk
from graphface.nodes.intrinsic.logarithm import finite_pixels, log_intensity, separated
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
    """log s = argmin_u sum |grad u| + lambda sum |log I - u|, TV-L1 of the log intensity.

    Chen, Yin, Zhou, Comaniciu, Huang, Total Variation Models for Variable Lighting Face Recognition, PAMI 2006; used
    for relighting by Li et al. (cited in the paper). TV-L1 parts by size, not by contrast: things narrower than
    2 / lambda leave u, however dark. Solved by the primal-dual method of Chambolle and Pock, JMIV 2011, section 6.2.

    Args:
        mask: H x W, over which shading gets the mean of the intensity.
        scale: radius of what counts as albedo, as a share of the longer side; lambda = 2 / radius.
        iterations: of the primal-dual method.
        resolution: longer side of the copy that is solved on.
        floor: least shading.

    Returns:
        albedo * shading is the photo.
    """
    pixels = finite_pixels(photo, "intrinsic.log_tv")
    intensity = log_intensity(pixels)
    small = log_intensity(shrunk(pixels, resolution))
    fidelity = 2 / max(scale * max(small.shape), 1.0)
    cartoon = _tv_l1(small, fidelity, iterations)
    return separated(pixels, lifted(cartoon, small, intensity), mask, floor)


def _tv_l1(values: FloatArray, fidelity: float, iterations: int) -> FloatArray:
    """Primal u, dual p: p <- project(p + step grad u), u <- shrink(u + step div p towards `values`)."""
    step = np.float32(1 / np.sqrt(8))  # step^2 |grad|^2 <= 1, the method's condition, |grad|^2 <= 8
    u, ahead = values.copy(), values
    down, across = np.zeros_like(values), np.zeros_like(values)
    for _ in range(iterations):
        rise, run = gradient(ahead)
        down += step * rise
        across += step * run
        length = np.maximum(np.sqrt(down * down + across * across), 1)
        down /= length
        across /= length
        moved = u + step * divergence(down, across) - values
        limit = step * np.float32(fidelity)
        moved = values + np.sign(moved) * np.maximum(np.abs(moved) - limit, 0)
        ahead, u = 2 * moved - u, moved
    return u
