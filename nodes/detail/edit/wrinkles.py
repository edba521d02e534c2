"""Smoothing and deepening wrinkles: the dark lines of the detail map."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node
from graphface.nodes.detail.edit.bands import decomposed, edited_map
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

    Creases are dark because they hide from light, so only the dark half of each band is touched: taking the bright
    half along would flatten highlights too (that is `detail.edit.shine`). Brows and lashes are dark lines as well;
    keep them with `where`.
    """

    def edit(values: FloatArray) -> FloatArray:
        _, lines, folds = decomposed(values, landmarks, "guided")
        dark = np.minimum(lines, 0) + np.minimum(folds, 0)
        return (values + (strength - 1) * dark).astype(np.float32, copy=False)

    return detail if strength == 1 else edited_map(detail, edit, where)
