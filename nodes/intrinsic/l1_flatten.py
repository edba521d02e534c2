"""Sparse reflectance: flatten the photo until few colors are left, then what was flattened is shading."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node
from graphface.nodes.intrinsic.lift import lifted, shrunk
from graphface.nodes.intrinsic.logarithm import chromaticity, finite_pixels, log_intensity, separated
from graphface.nodes.intrinsic.poisson import divergence, gradient, solve
from graphface.nodes.types import FloatArray, Image, Intrinsic, Mask

_LUMINANCE = 0.3
"""Weight of log intensity beside chromaticity (times 3, so that both are relative changes): shading alters it too."""


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
    """Edges that survive flattening are reflectance.

    z = argmin sum w_ij |z_i - z_j|_1 + (1 / flatness) sum |z_i - f_i|^2 over neighbours i, j.

    Bi, Han, Yu, An L1 Image Transform for Edge-Preserving Smoothing and Scene-Level Intrinsic Decomposition, SIGGRAPH
    2015: the local sparseness and the approximation term of their energy, by split Bregman, on a color f in which
    brightness counts little, so that shading gradients are flattened and changes of hue are not. Then, as in their
    second stage, reflectance is made constant where z is, and shading smooth where z is not: a Poisson problem. (Their
    global term, between superpixels far apart, and their clustering of reflectances are left out.)

    Args:
        mask: H x W, over which shading gets the mean of the intensity.
        flatness: how far the flattening reaches. similar: color difference beyond which neighbours are not joined.
        edge: step of the flattened color that counts as a change of reflectance.
        iterations: of split Bregman. resolution: longer side of the copy that is solved on.
        floor: least shading.

    Returns:
        albedo * shading is the photo.
    """
    pixels = finite_pixels(photo, "intrinsic.l1_flatten")
    tiny = shrunk(pixels, resolution)
    intensity = log_intensity(tiny)
    color = np.concatenate([np.float32(_LUMINANCE) * intensity[..., None], 3 * chromaticity(tiny)], axis=2)
    weights = [_alike(step, similar) for step in gradient(color)]
    flat = _flattened(color, weights, flatness, iterations)
    kept = [step * (1 - _alike(across, edge)) for step, across in zip(gradient(intensity), gradient(flat), strict=True)]
    reflectance = solve(-divergence(kept[0], kept[1]), screen=0)
    return separated(pixels, lifted(intensity - reflectance, intensity, log_intensity(pixels)), mask, floor)


def _alike(step: FloatArray, similar: float) -> FloatArray:
    alike: FloatArray = np.exp(-np.einsum("hwc,hwc->hw", step, step) / np.float32(2 * similar**2))
    return alike


def _flattened(values: FloatArray, weights: list[FloatArray], flatness: float, iterations: int) -> FloatArray:
    """Split Bregman: d stands for grad z; z by one Poisson solve, d by shrinkage with the weights as thresholds."""
    coupling = np.float32(2.0)
    flat = values
    shrunken = [np.zeros_like(values), np.zeros_like(values)]
    left = [np.zeros_like(values), np.zeros_like(values)]
    for _ in range(iterations):
        target = divergence(shrunken[0] - left[0], shrunken[1] - left[1])
        flat = solve(values / np.float32(flatness) - coupling * target, screen=1 / flatness, stiffness=float(coupling))
        for axis, step in enumerate(gradient(flat)):
            moved = step + left[axis]
            shrunken[axis] = np.sign(moved) * np.maximum(np.abs(moved) - weights[axis][..., None] / coupling, 0)
            left[axis] = moved - shrunken[axis]
    return flat
