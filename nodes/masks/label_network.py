"""The label network: a small U-Net that says of every pixel about a head what it is, in plain NumPy.

It works on cells of two by two pixels and tells all four apart at the end, which is four times as cheap as working on
pixels. Each level down halves the picture: two convolutions, means of two by two; each level up adds what the level
below saw, and convolves once more. Normalization was folded into the weights when they were learned
(`graphface models labels`).
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.types import FloatArray

WIDTHS = (16, 32, 48, 64)
"""Channels at each level, finest first."""


MULTIPLICATIONS = 1 << 17
"""In one matrix product, as in `masks.mixture`: OpenBLAS starts no threads of its own for less."""


Weights = Mapping[str, NDArray[np.float32]]


def label_scores(cells: FloatArray, weights: Weights) -> FloatArray:
    """Scores (logits) of face, hair and background, float32 2h x 2w x 3.

    Args:
        cells: h x w x C as of `masks.network_input`, h and w multiples of 8.
    """
    levels = []
    for level in range(len(WIDTHS)):
        for step in range(2):
            place = f"down.{level}.{step}"
            cells = rectified(convolved(_halved(cells) if level and not step else cells, weights, place))
        levels.append(cells)
    for level in reversed(range(len(WIDTHS) - 1)):
        wider = convolved(cells, weights, f"across.{level}")
        cells = levels[level] + wider.repeat(2, axis=0).repeat(2, axis=1)
        cells = rectified(convolved(cells, weights, f"up.{level}"))
    return _shuffled(convolved(cells, weights, "out"))


def convolved(cells: FloatArray, weights: Weights, place: str) -> FloatArray:
    """h x w x C convolved with kernels k x k x C x D, plus their bias; beyond the picture everything is 0."""
    kernel, bias = weights[f"{place}.weight"], weights[f"{place}.bias"]
    size, _, inputs, outputs = kernel.shape
    height, width = cells.shape[:2]
    if size == 1:
        columns = cells.reshape(-1, inputs)
    else:
        margin = size // 2
        padded = np.pad(cells, ((margin, margin), (margin, margin), (0, 0)))
        columns = np.empty((height, width, size * size, inputs), np.float32)
        for down in range(size):
            for right in range(size):
                columns[:, :, down * size + right] = padded[down : down + height, right : right + width]
        columns = columns.reshape(-1, size * size * inputs)
    found = _product(columns, kernel.reshape(-1, outputs))
    found += bias
    return found.reshape(height, width, outputs)


def rectified(values: FloatArray) -> FloatArray:
    """What is below 0 is 0."""
    return np.maximum(values, 0, out=values)


def _product(rows: FloatArray, matrix: FloatArray) -> FloatArray:
    step = max(1, MULTIPLICATIONS // matrix.size)
    found = np.empty((len(rows), matrix.shape[1]), np.float32)
    for start in range(0, len(rows), step):
        np.matmul(rows[start : start + step], matrix, out=found[start : start + step])
    return found


def _halved(cells: FloatArray) -> FloatArray:
    """Means of two by two."""
    rows = cells[::2] + cells[1::2]
    return np.asarray((rows[:, ::2] + rows[:, 1::2]) * np.float32(0.25))


def _shuffled(cells: FloatArray) -> FloatArray:
    """h x w x 4C to 2h x 2w x C; of C's four, in that order: upper left, upper right, lower left, lower right."""
    height, width, channels = cells.shape
    apart = cells.reshape(height, width, channels // 4, 2, 2).transpose(0, 3, 1, 4, 2)
    return np.ascontiguousarray(apart.reshape(2 * height, 2 * width, channels // 4))
