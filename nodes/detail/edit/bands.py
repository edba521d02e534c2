"""Frequency bands of a detail map, scaled."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node
from graphface.nodes.detail.edit.frequencies import Kernel, decomposed, edited_map
from graphface.nodes.types import DetailMap, FloatArray, Landmarks, Mask

Amount = Annotated[float, Field(ge=0, le=4)]


@node("detail.edit.bands")
def bands(
    detail: DetailMap,
    landmarks: Landmarks,
    where: Mask | None = None,
    *,
    pores: Amount = 1.0,
    lines: Amount = 1.0,
    folds: Amount = 1.0,
    kernel: Kernel = "gaussian",
) -> DetailMap:
    """Scale each frequency band of a detail map: 0 removes it, 1 keeps it, 2 doubles it.

    After Boyadzhiev, Bala, Paris, Adelson, Band-Sifting Decomposition for Image-Based Material Editing, TOG 2015. The
    offset is scaled itself, the gain by its logarithm.

    Args:
        where: H x W in 0..1, the weight of the edit; without it every pixel is edited.
        pores, lines, folds: factors of the bands up to 0.01, 0.03 and 0.1 inter-ocular distances.
        kernel: "gaussian" bands are linear; "guided" ones keep strong edges (lips, lashes) out of the finer bands.
    """
    amounts = (pores, lines, folds)
    if amounts == (1, 1, 1):
        return detail

    def edit(values: FloatArray) -> FloatArray:
        edited = values.copy()
        for band, amount in zip(decomposed(values, landmarks, kernel), amounts, strict=True):
            if amount != 1:
                edited += np.float32(amount - 1) * band
        return edited

    return edited_map(detail, edit, where)
