"""Which face pixel each pixel beyond the face takes after."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node, warn
from graphface.nodes.render.beyond import cell_means, core_of, nearest_core, smooth_step
from graphface.nodes.types import Landmarks, Mask, Surface, Surroundings

Length = Annotated[float, Field(gt=0, le=10)]


Resolution = Annotated[int, Field(ge=8, le=256)]


@node("render.surroundings")
def surroundings(
    mask: Mask,
    surface: Surface,
    landmarks: Landmarks,
    *,
    smoothing: Length = 0.25,
    resolution: Resolution = 32,
) -> Surroundings:
    """Which face pixel each pixel beyond the face is nearest to, and how smoothly it takes after it.

    Args:
        mask: the face; between 0 and 1 its shading goes over into the continued one.
        surface: only where it covers the picture is the shading known.
        smoothing: width of the blur beside the face, in inter-ocular distances; it triples with distance.
        resolution: least cells per inter-ocular distance of the small copy that is worked on.
    """
    weight = mask * (surface.coverage > 0)
    cell = max(1, min(int(landmarks.interocular / resolution), *weight.shape))
    total = cell_means(weight, cell)
    sigma = max(smoothing * landmarks.interocular / cell, 0.5)
    core = core_of(total)
    if core is None:
        warn(
            "render.surroundings: the mask is empty; shading is taken as 0 everywhere, so no light changes the picture"
        )
        nothing = np.zeros((0, 0), np.float32)
        return Surroundings(weight, cell, (0, 0, 0, 0), nothing, np.zeros((0, 0), np.intp), nothing, sigma)
    nearest, distance = nearest_core(core)
    down, across = (np.flatnonzero(core.any(axis=axis)) for axis in (1, 0))
    top, bottom, left, right = window = (int(down[0]), int(down[-1]) + 1, int(across[0]), int(across[-1]) + 1)
    row, column = np.divmod(nearest, core.shape[1])
    return Surroundings(
        weight=weight,
        cell=cell,
        window=window,
        total=np.ascontiguousarray(total[top:bottom, left:right]),
        nearest=(row - top) * (right - left) + (column - left),
        far=smooth_step(distance / np.float32(4 * sigma)),
        sigma=sigma,
    )
