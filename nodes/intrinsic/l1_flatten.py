"""Sparse reflectance: flatten the photo to few colors; what the flattening removes is shading."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node
from graphface.nodes.intrinsic.guided_upsampling import reduced, upsampled
from graphface.nodes.intrinsic.log_domain import chromaticity, finite_pixels, intrinsic_images, log_intensity
from graphface.nodes.intrinsic.poisson import divergence, gradient, solve
from graphface.nodes.types import FloatArray, Image, Intrinsic, Mask

_LUMINANCE = 0.3
"""Weight of log intensity beside chromaticity, because shading changes it too. (Chromaticity is multiplied by 3, so
that both are relative changes.)"""


_COUPLING = 2.0
"""lambda of split Bregman: weight of |d - grad z - b|^2."""


@node("intrinsic.l1_flatten")
def l1_flatten(
    photo: Image,
    mask: Mask | None = None,
    *,
    flatness: Annotated[float, Field(gt=0, le=1000)] = 4.0,
    similar: Annotated[float, Field(gt=0, le=10)] = 0.08,
    edge: Annotated[float, Field(gt=0, le=10)] = 0.015,
    iterations: Annotated[int, Field(ge=1, le=500)] = 20,
    resolution: Annotated[int, Field(ge=16, le=8192)] = 320,
    floor: Annotated[float, Field(gt=0, le=1)] = 0.05,
) -> Intrinsic:
    """Edges that remain after flattening are reflectance.

    z = argmin sum w_ij |z_i - z_j|_1 + (1 / flatness) sum |z_i - f_i|^2 over neighbours i, j.

    Bi, Han, Yu, An L1 Image Transform for Edge-Preserving Smoothing and Scene-Level Intrinsic Decomposition, SIGGRAPH
    2015: the local sparseness and the approximation term of their energy, by split Bregman, on a color f in which
    brightness has a low weight, so that gradients of shading are flattened and changes of hue are not. Then, as in
    their second stage, reflectance is constant where z is, and shading smooth elsewhere: a Poisson problem. (Left out:
    their global term between superpixels, and their clustering of reflectances.)

    Args:
        mask: H x W; over it shading gets the mean of the intensity.
        flatness: weight of flatness over similarity to the photo.
        similar: standard deviation of the color difference in the weight w_ij of two neighbours.
        edge: standard deviation of the step of z that is a change of reflectance.
        iterations: of split Bregman.
        resolution: longer side in pixels of the copy on which the problem is solved.
        floor: least shading.

    Returns:
        albedo * shading is the photo.
    """
    pixels = finite_pixels(photo, "intrinsic.l1_flatten")
    small = reduced(pixels, resolution)
    intensity = log_intensity(small)
    color = np.concatenate([np.float32(_LUMINANCE) * intensity[..., None], 3 * chromaticity(small)], axis=2)
    weights = [_similarity(step, similar) for step in gradient(color)]
    flat = _flattened(color, weights, flatness, iterations)
    steps = zip(gradient(intensity), gradient(flat), strict=True)
    kept = [step * (1 - _similarity(flat_step, edge)) for step, flat_step in steps]
    reflectance = solve(-divergence(kept[0], kept[1]), screen=0)
    return intrinsic_images(pixels, upsampled(intensity - reflectance, intensity, log_intensity(pixels)), mask, floor)


def _similarity(step: FloatArray, sigma: float) -> FloatArray:
    """exp(-|step|^2 / (2 sigma^2)), H x W, for steps H x W x c."""
    similarity: FloatArray = np.exp(-np.einsum("hwc,hwc->hw", step, step) / np.float32(2 * sigma**2))
    return similarity


def _flattened(values: FloatArray, weights: list[FloatArray], flatness: float, iterations: int) -> FloatArray:
    """Split Bregman (Goldstein and Osher, SIAM J. Imaging Sciences 2009): z by a Poisson solve, d by shrinkage.

    d stands for grad z, b is the Bregman variable; each has one array per axis.
    """
    coupling = np.float32(_COUPLING)
    z = values
    d = [np.zeros_like(values), np.zeros_like(values)]
    b = [np.zeros_like(values), np.zeros_like(values)]
    for _ in range(iterations):
        target = divergence(d[0] - b[0], d[1] - b[1])
        z = solve(values / np.float32(flatness) - coupling * target, screen=1 / flatness, stiffness=_COUPLING)
        for axis, step in enumerate(gradient(z)):
            moved = step + b[axis]
            d[axis] = np.sign(moved) * np.maximum(np.abs(moved) - weights[axis][..., None] / coupling, 0)
            b[axis] = moved - d[axis]
    return z
