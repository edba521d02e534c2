"""How a shading known on the face continues beyond it: all that does not depend on the light."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node, warn
from graphface.nodes.render.nearest_face import block_means, face_core, nearest_pixel
from graphface.nodes.smoothstep import smoothstep
from graphface.nodes.types import Landmarks, Mask, Surface, Surroundings


@node("render.surroundings")
def surroundings(
    mask: Mask,
    surface: Surface,
    landmarks: Landmarks,
    *,
    smoothing: Annotated[float, Field(gt=0, le=10)] = 0.25,
    resolution: Annotated[int, Field(ge=8, le=256)] = 32,
) -> Surroundings:
    """The nearest face pixel of each pixel beyond the face, and how much the continued shading is blurred there.

    Args:
        mask: the face, H x W; where it is between 0 and 1 the shading on the face blends into the continued one.
        surface: the shading is known only where it covers the picture.
        smoothing: standard deviation of the blur beside the face, in inter-ocular distances; it triples with distance.
        resolution: least blocks per inter-ocular distance of the small copy on which the shading is continued.
    """
    weight = mask * (surface.coverage > 0)
    cell = max(1, min(int(landmarks.interocular / resolution), *weight.shape))
    total = block_means(weight, cell)
    sigma = max(smoothing * landmarks.interocular / cell, 0.5)
    core = face_core(total)
    if core is None:
        warn(
            "render.surroundings: the mask is empty; shading is taken as 0 everywhere, so no light changes the picture"
        )
        nothing = np.zeros((0, 0), np.float32)
        return Surroundings(weight, cell, (0, 0, 0, 0), nothing, np.zeros((0, 0), np.intp), nothing, sigma)
    nearest, distance = nearest_pixel(core)
    rows, columns = (np.flatnonzero(core.any(axis=axis)) for axis in (1, 0))
    window = top, bottom, left, right = int(rows[0]), int(rows[-1]) + 1, int(columns[0]), int(columns[-1]) + 1
    row, column = np.divmod(nearest, core.shape[1])
    return Surroundings(
        weight=weight,
        cell=cell,
        window=window,
        total=np.ascontiguousarray(total[top:bottom, left:right]),
        nearest=(row - top) * (right - left) + (column - left),
        far=smoothstep(distance / np.float32(4 * sigma)),
        sigma=sigma,
    )
