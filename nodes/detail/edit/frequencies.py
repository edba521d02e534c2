"""A detail map decomposed into frequency bands, and edited by a function of its values."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Literal

import numpy as np

from graphface.nodes.types import DetailMap, FloatArray, Landmarks, Mask

EDGES = (0.01, 0.03, 0.1)
"""Upper ends of the bands: standard deviations of the blurs between them, in inter-ocular distances. Pores and noise
are below 1 %, fine lines below 3 %, wrinkles and folds below 10 %. What is broader is shading and does not change."""


Kernel = Literal["gaussian", "guided"]


_LEAST_GAIN = 1e-3


_LARGEST_LOG_GAIN = 7.0


_EDGE_CONTRAST = 0.05
"""Standard deviation within a window above which the guided filter keeps an edge, in the map's unit."""


def decomposed(values: FloatArray, landmarks: Landmarks, kernel: Kernel = "gaussian") -> list[FloatArray]:
    """The bands of a map H x W (x c) between the `EDGES`, finest first; with the last blur they add up to the map."""
    smooth = guided if kernel == "guided" else gaussian
    interocular, finer, found = max(landmarks.interocular, 1e-3), values, []
    for edge in EDGES:
        coarser = smooth(values, edge * interocular)
        found.append(finer - coarser)
        finer = coarser
    return found


def edited_map(detail: DetailMap, edit: Callable[[FloatArray], FloatArray], where: Mask | None) -> DetailMap:
    """A detail map with `edit` applied to its offset and to the logarithm of its gain, so that no gain changes sign.

    Args:
        edit: of values H x W x 3.
        where: H x W, 0..1, the weight of the edit; None edits every pixel.
    """
    offset = _blended(detail.offset, edit(detail.offset), where)
    if detail.gain is None:
        return replace(detail, offset=offset)
    logarithm = np.log(np.maximum(detail.gain, np.float32(_LEAST_GAIN)))
    logarithm = np.clip(_blended(logarithm, edit(logarithm), where), -_LARGEST_LOG_GAIN, _LARGEST_LOG_GAIN)
    return replace(detail, offset=offset, gain=np.exp(logarithm).astype(np.float32, copy=False))


def gaussian(values: FloatArray, sigma: float) -> FloatArray:
    """Gaussian blur of standard deviation `sigma` pixels; below 0.3 pixels the values themselves."""
    import cv2

    if sigma < 0.3:
        return values
    return np.asarray(cv2.GaussianBlur(values, (0, 0), sigma, borderType=cv2.BORDER_REPLICATE), np.float32)


def guided(values: FloatArray, sigma: float) -> FloatArray:
    """Guided filter with the map as its own guide, radius 2 sigma (He, Sun, Tang, TPAMI 2013, equations 5, 6 and 8)."""
    radius = max(1, round(2 * sigma))

    def box(x: FloatArray) -> FloatArray:
        import cv2

        return np.asarray(cv2.blur(x, (2 * radius + 1,) * 2, borderType=cv2.BORDER_REPLICATE), np.float32)

    mean = box(values)
    variance = np.maximum(box(values * values) - mean * mean, np.float32(0))
    slope = np.asarray(variance / (variance + np.float32(_EDGE_CONTRAST * _EDGE_CONTRAST)), np.float32)
    return box(slope) * values + box(mean * (1 - slope))


def _blended(before: FloatArray, after: FloatArray, where: Mask | None) -> FloatArray:
    return after if where is None else before + where[..., None] * (after - before)
