"""Wrinkles: dark lines of the detail map."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node
from graphface.nodes.detail.edit.frequencies import decomposed, edited_map
from graphface.nodes.types import DetailMap, FloatArray, Landmarks, Mask


@node("detail.edit.wrinkles")
def wrinkles(
    detail: DetailMap,
    landmarks: Landmarks,
    where: Mask | None = None,
    *,
    strength: Annotated[float, Field(ge=0, le=4)] = 0.4,
) -> DetailMap:
    """Scale what is darker than its surroundings at the size of lines and folds: 0 smooths, 2 doubles the depth.

    Creases are dark because they are occluded, so only the negative half of each band changes. The positive half has
    highlights, which `detail.edit.shine` scales.

    Args:
        where: H x W in 0..1, the weight of the edit; brows and lashes are dark lines too, so leave them out.
        strength: factor of the wrinkles.
    """

    def edit(values: FloatArray) -> FloatArray:
        _, lines, folds = decomposed(values, landmarks, "guided")
        dark = np.minimum(lines, 0) + np.minimum(folds, 0)
        return (values + (strength - 1) * dark).astype(np.float32, copy=False)

    return detail if strength == 1 else edited_map(detail, edit, where)
