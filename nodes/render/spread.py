"""Shading beyond the face, where there is no geometry (paper, section 3.1, "compositing non-face pixels").

Each pixel outside the face takes the shading of its nearest face pixel, and the result is smoothed. The estimated and
the new shading go through the same linear operation: where they agree on the face they agree everywhere, so an
unchanged light changes no pixel, and along the mask's edge there is nothing to see.

Nearest-pixel fields are streaky and smooth fields need no resolution, so this runs on a small copy in which the
inter-ocular distance has `resolution` pixels; on the face itself the full-resolution shading is kept.
"""

from __future__ import annotations

import numpy as np

from graphface import node
from graphface.nodes.blur import blurred
from graphface.nodes.color import in_three_channels
from graphface.nodes.render.beyond import cell_means
from graphface.nodes.strips import by_strips
from graphface.nodes.types import FloatArray, Mask, Shading, Surroundings


@node("render.spread")
def spread(shading: Shading, surroundings: Surroundings) -> Shading:
    """A shading known on the face, continued over the whole picture.

    Args:
        shading: H x W or H x W x 3, valid where there is a surface.

    Returns:
        float32 of the shape of `shading`: `shading` where the mask is 1, defined everywhere.
    """
    import cv2

    weight, cell = surroundings.weight, surroundings.cell
    if surroundings.total.size == 0:
        return np.zeros_like(shading)
    on_face = _on_face(shading, surroundings)
    nearest = on_face.reshape(-1, *on_face.shape[2:]).take(surroundings.nearest, axis=0)
    near, far = (blurred(nearest, sigma) for sigma in (surroundings.sigma, 3 * surroundings.sigma))
    small = near + (far - near) * _like(surroundings.far, shading)
    size = small.shape[1] * cell, small.shape[0] * cell
    beyond = np.asarray(cv2.resize(small, size, interpolation=cv2.INTER_LINEAR), np.float32)
    whole = np.empty(shading.shape, np.float32)
    width = shading.shape[1]

    def join(rows: slice) -> None:
        outside = beyond[rows, :width]
        inside = np.subtract(shading[rows], outside, out=whole[rows])
        inside *= _like(weight[rows], shading)
        inside += outside

    by_strips(join, whole.shape)
    return whole


def _on_face(shading: Shading, surroundings: Surroundings) -> FloatArray:
    """The shading's weighted means over the cells of the window."""
    cell, (top, bottom, left, right) = surroundings.cell, surroundings.window
    part = np.s_[top * cell : bottom * cell, left * cell : right * cell]
    seen, weight = shading[part], surroundings.weight[part]
    weighted = np.empty(seen.shape, np.float32)

    def strip(rows: slice) -> None:
        np.multiply(seen[rows], _like(weight[rows], shading), out=weighted[rows])

    by_strips(strip, weighted.shape)
    return cell_means(weighted, cell) / _like(np.maximum(surroundings.total, np.float32(1e-12)), shading)


def _like(weight: Mask, shading: Shading) -> FloatArray:
    return in_three_channels(weight) if shading.ndim == 3 else weight
