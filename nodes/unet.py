"""A small U-Net in plain NumPy, for networks that are learned with `graphface models`.

It works on cells of 2 x 2 pixels and gives the values of the four pixels of each cell at the end (pixel shuffle), which
costs a quarter of working on pixels. On the way down each level halves the picture: average pooling, then two
convolutions. On the way up each level adds the upsampled result of the level below, and convolves once. Batch
normalization was folded into the weights after training.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.types import FloatArray

MULTIPLICATIONS = 1 << 17
"""In one matrix product, as in `masks.mixture`: below this OpenBLAS starts no threads of its own."""


Weights = Mapping[str, NDArray[np.float32]]
"""By layer: `down.LEVEL.STEP`, `across.LEVEL`, `up.LEVEL` and `out`, each with `.weight` k x k x C x D and `.bias`."""


def unet(cells: FloatArray, weights: Weights, levels: int) -> FloatArray:
    """The network's output, float32 2h x 2w x D.

    Args:
        cells: h x w x C, h and w multiples of 2^(levels - 1).
    """
    kept = []
    for level in range(levels):
        for step in range(2):
            layer = f"down.{level}.{step}"
            cells = relu(convolved(_average_pooled(cells) if level and not step else cells, weights, layer))
        kept.append(cells)
    for level in reversed(range(levels - 1)):
        below = convolved(cells, weights, f"across.{level}")
        cells = kept[level] + below.repeat(2, axis=0).repeat(2, axis=1)
        cells = relu(convolved(cells, weights, f"up.{level}"))
    return _pixel_shuffled(convolved(cells, weights, "out"))


def convolved(cells: FloatArray, weights: Weights, layer: str) -> FloatArray:
    """h x w x C convolved with a layer's kernels k x k x C x D, plus its bias; zero padding."""
    kernel, bias = weights[f"{layer}.weight"], weights[f"{layer}.bias"]
    size, _, inputs, outputs = kernel.shape
    height, width = cells.shape[:2]
    margin, row = size // 2, width + size - 1
    # The padded cells as one long list. The neighbor at (down, right) of all cells is a slice of it, and needs no copy;
    # the last columns of each row are the neighbors of none, and are cut off at the end.
    padded = np.zeros(((height + size - 1) * row + size - 1, inputs), np.float32)
    grid = padded[: (height + size - 1) * row].reshape(-1, row, inputs)
    grid[margin : margin + height, margin : margin + width] = cells
    steps = [(down * row + right, kernel[down, right]) for down in range(size) for right in range(size)]
    found = np.empty((height * row, outputs), np.float32)
    chunk = max(1, MULTIPLICATIONS // (inputs * outputs))
    for start in range(0, len(found), chunk):
        part = found[start : start + chunk]
        part[...] = bias
        for step, matrix in steps:
            part += padded[start + step : start + step + len(part)] @ matrix
    return np.ascontiguousarray(found.reshape(height, row, outputs)[:, :width])


def relu(values: FloatArray) -> FloatArray:
    """Values below 0 become 0, in place."""
    return np.maximum(values, 0, out=values)


def _average_pooled(cells: FloatArray) -> FloatArray:
    """Means of 2 x 2 cells."""
    rows = cells[::2] + cells[1::2]
    return np.asarray((rows[:, ::2] + rows[:, 1::2]) * np.float32(0.25))


def _pixel_shuffled(cells: FloatArray) -> FloatArray:
    """h x w x 4C to 2h x 2w x C. Each channel's four values are upper left, upper right, lower left, lower right."""
    height, width, channels = cells.shape
    pixels = cells.reshape(height, width, channels // 4, 2, 2).transpose(0, 3, 1, 4, 2)
    return np.ascontiguousarray(pixels.reshape(2 * height, 2 * width, channels // 4))
