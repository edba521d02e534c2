"""Shading beyond the face, where there is no geometry (paper, section 4.1, "compositing non-face pixels").

Each pixel outside the face takes the shading of its nearest face pixel, and the result is smoothed. The estimated and
the new shading go through the same linear operation. Where they agree on the face they agree everywhere, so an
unchanged light changes no pixel and no edge shows along the mask.

The nearest-pixel field is streaky and its blur is smooth, so neither needs the full resolution: both are computed on a
small copy whose pixels are means over blocks. On the face itself the shading keeps its full resolution.
"""

from __future__ import annotations

import numpy as np

from graphface import node
from graphface.nodes.blur import blurred
from graphface.nodes.color import with_channels_of
from graphface.nodes.render.nearest_face import block_means
from graphface.nodes.strips import by_strips
from graphface.nodes.types import FloatArray, Shading, Surroundings


@node("render.spread")
def spread(shading: Shading, surroundings: Surroundings) -> Shading:
    """Continue a shading that is known on the face over the whole picture.

    Args:
        shading: H x W or H x W x 3, valid where there is a surface.

    Returns:
        float32 of the shape of `shading`, defined everywhere; equal to `shading` where the mask is 1.
    """
    import cv2

    weight, cell = surroundings.weight, surroundings.cell
    if surroundings.total.size == 0:
        return np.zeros_like(shading)
    on_face = _block_means_on_face(shading, surroundings)
    nearest = on_face.reshape(-1, *on_face.shape[2:]).take(surroundings.nearest, axis=0)
    near, far = (blurred(nearest, sigma) for sigma in (surroundings.sigma, 3 * surroundings.sigma))
    small = near + (far - near) * with_channels_of(surroundings.far, shading)
    size = small.shape[1] * cell, small.shape[0] * cell
    continued = np.asarray(cv2.resize(small, size, interpolation=cv2.INTER_LINEAR), np.float32)
    whole = np.empty(shading.shape, np.float32)
    width = shading.shape[1]

    def join(rows: slice) -> None:
        outside = continued[rows, :width]
        inside = np.subtract(shading[rows], outside, out=whole[rows])
        inside *= with_channels_of(weight[rows], shading)
        inside += outside

    by_strips(join, whole.shape)
    return whole


def _block_means_on_face(shading: Shading, surroundings: Surroundings) -> FloatArray:
    """The shading's means over the blocks of the window, weighted by the mask."""
    cell, (top, bottom, left, right) = surroundings.cell, surroundings.window
    window = np.s_[top * cell : bottom * cell, left * cell : right * cell]
    part, weight = shading[window], surroundings.weight[window]
    weighted = np.empty(part.shape, np.float32)

    def strip(rows: slice) -> None:
        np.multiply(part[rows], with_channels_of(weight[rows], shading), out=weighted[rows])

    by_strips(strip, weighted.shape)
    return block_means(weighted, cell) / with_channels_of(np.maximum(surroundings.total, np.float32(1e-12)), shading)
