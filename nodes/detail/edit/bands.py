"""Editing a detail map by frequency band (after Boyadzhiev et al. 2015, cited in the paper)."""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from graphface import node
from graphface.nodes.types import DetailMap, FloatArray, Landmarks, Mask

EDGES = (0.01, 0.03, 0.1)
"""Where bands meet, standard deviations in inter-ocular distances: pores and noise below 1 %, fine lines to 3 %,
wrinkles and folds to 10 %; what is broader is shading and is left alone."""


_LEAST_GAIN = 1e-3


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
    kernel: Literal["gaussian", "guided"] = "gaussian",
) -> DetailMap:
    """Scale each frequency band of a detail map: 0 removes it, 1 keeps it, 2 doubles it.

    Boyadzhiev, Bala, Paris, Adelson, Band-Sifting Decomposition for Image-Based Material Editing, TOG 2015. An offset
    is edited as it is, a gain as its logarithm, so that no gain changes sign.

    Args:
        where: H x W, where the edit applies, 0..1; everywhere by default.
        pores, lines, folds: for detail up to 0.01, 0.03 and 0.1 inter-ocular distances.
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


def decomposed(values: FloatArray, landmarks: Landmarks, kernel: str = "gaussian") -> list[FloatArray]:
    """The bands of a map between the `EDGES`, finest first; they and the last blur add up to it."""
    smooth = guided if kernel == "guided" else gaussian
    unit, finer, found = max(landmarks.interocular, 1e-3), values, []
    for edge in EDGES:
        coarser = smooth(values, edge * unit)
        found.append(finer - coarser)
        finer = coarser
    return found


def edited_map(detail: DetailMap, edit: object, where: Mask | None) -> DetailMap:
    """A detail map with `edit` done to its offset and to the logarithm of its gain, blended in by `where`."""
    assert callable(edit)
    offset = _blend(detail.offset, edit(detail.offset), where)
    if detail.gain is None:
        return replace(detail, offset=offset)
    logarithm = np.log(np.maximum(detail.gain, np.float32(_LEAST_GAIN)))
    gain = np.exp(np.clip(_blend(logarithm, edit(logarithm), where), -7, 7)).astype(np.float32, copy=False)
    return replace(detail, offset=offset, gain=gain)


def gaussian(values: FloatArray, sigma: float) -> FloatArray:
    """Gaussian blur; a sigma below a third of a pixel is none."""
    import cv2

    if sigma < 0.3:
        return values
    return np.asarray(cv2.GaussianBlur(values, (0, 0), sigma, borderType=cv2.BORDER_REPLICATE), np.float32)


def guided(values: FloatArray, sigma: float, *, edge: float = 0.05) -> FloatArray:
    """Guided filter of a map by itself (He et al., TPAMI 2013): variation above `edge` counts as an edge and stays."""
    radius = max(1, round(2 * sigma))

    def box(x: FloatArray) -> FloatArray:
        import cv2

        return np.asarray(cv2.blur(x, (2 * radius + 1,) * 2, borderType=cv2.BORDER_REPLICATE), np.float32)

    mean = box(values)
    variance = np.maximum(box(values * values) - mean * mean, np.float32(0))
    slope = np.asarray(variance / (variance + np.float32(edge * edge)), np.float32)
    return box(slope) * values + box(mean * (1 - slope))


def _blend(before: FloatArray, after: FloatArray, where: Mask | None) -> FloatArray:
    return after if where is None else before + where[..., None] * (after - before)
