"""Shading beyond the face, where there is no geometry (paper, section 3.1, "compositing non-face pixels").

Each pixel outside the face takes the shading of its nearest face pixel, and the result is smoothed. The estimated and
the new shading go through the same linear operation: where they agree on the face they agree everywhere, so an
unchanged light changes no pixel, and along the mask's edge there is nothing to see.

Nearest-pixel fields are streaky and smooth fields need no resolution, so this runs on a small copy in which the
inter-ocular distance has `resolution` pixels; on the face itself the full-resolution shading is kept.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from graphface import node, warn
from graphface.nodes.blur import blurred
from graphface.nodes.detail.rendering import in_three_channels
from graphface.nodes.render.scene import Scene
from graphface.nodes.strips import by_strips
from graphface.nodes.types import FloatArray, Landmarks, Mask, Shading, Surface

Length = Annotated[float, Field(gt=0, le=10)]
Resolution = Annotated[int, Field(ge=8, le=256)]


@dataclass(frozen=True)
class Surroundings:
    """How a shading goes on beyond a face: all of `render.spread` that the light does not change.

    `weight` H x W is the soft mask where there is a surface. The small copy has cells of `cell` x `cell` pixels, h x w
    of them; the face lies in the cells `window` (top, bottom, left, right). `total` are the weight's means over the
    window's cells; `nearest` intp h x w, the place of the face cell that each cell copies, counted row by row in the
    window; `far` h x w, 0..1, how much of the wider of two blurs it takes; `sigma`, the narrower's width in cells.
    Without a face all but `weight` are empty.
    """

    weight: Mask
    cell: int
    window: tuple[int, int, int, int]
    total: FloatArray
    nearest: NDArray[np.intp]
    far: FloatArray
    sigma: float


@node("render.surroundings")
def surroundings(
    mask: Mask,
    surface: Surface,
    landmarks: Landmarks,
    *,
    smoothing: Length = 0.25,
    resolution: Resolution = 32,
) -> Surroundings:
    """Which face pixel each pixel beyond the face is nearest to, and how smoothly it takes after it.

    Args:
        mask: the face; between 0 and 1 its shading goes over into the continued one.
        surface: only where it covers the picture is the shading known.
        smoothing: width of the blur beside the face, in inter-ocular distances; it triples with distance.
        resolution: least cells per inter-ocular distance of the small copy that is worked on.
    """
    weight = mask * (surface.coverage > 0)
    cell = max(1, min(int(landmarks.interocular / resolution), *weight.shape))
    total = _means(weight, cell)
    sigma = max(smoothing * landmarks.interocular / cell, 0.5)
    core = _core(total)
    if core is None:
        warn(
            "render.surroundings: the mask is empty; shading is taken as 0 everywhere, so no light changes the picture"
        )
        nothing = np.zeros((0, 0), np.float32)
        return Surroundings(weight, cell, (0, 0, 0, 0), nothing, np.zeros((0, 0), np.intp), nothing, sigma)
    nearest, distance = _nearest(core)
    down, across = (np.flatnonzero(core.any(axis=axis)) for axis in (1, 0))
    top, bottom, left, right = window = (int(down[0]), int(down[-1]) + 1, int(across[0]), int(across[-1]) + 1)
    row, column = np.divmod(nearest, core.shape[1])
    return Surroundings(
        weight=weight,
        cell=cell,
        window=window,
        total=np.ascontiguousarray(total[top:bottom, left:right]),
        nearest=(row - top) * (right - left) + (column - left),
        far=_smooth_step(distance / np.float32(4 * sigma)),
        sigma=sigma,
    )


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
    return _means(weighted, cell) / _like(np.maximum(surroundings.total, np.float32(1e-12)), shading)


def _means(values: FloatArray, cell: int) -> FloatArray:
    """Means over cells of so many pixels squared; what a cell has beyond the picture counts as 0."""
    import cv2

    height, width = values.shape[:2]
    rows, columns = -(-height // cell), -(-width // cell)
    padding = (0, rows * cell - height, 0, columns * cell - width)
    if any(padding):
        values = np.asarray(cv2.copyMakeBorder(values, *padding, cv2.BORDER_CONSTANT, value=0), np.float32)
    return np.asarray(cv2.resize(values, (columns, rows), interpolation=cv2.INTER_AREA), np.float32)


def _like(weight: Mask, shading: Shading) -> FloatArray:
    return in_three_channels(weight) if shading.ndim == 3 else weight


@node("render.background")
def background(
    estimated: Shading,
    relit: Shading,
    mask: Mask,
    landmarks: Landmarks,
    scene: Scene,
    *,
    near: Annotated[float, Field(ge=0, le=10)] = 0.6,
    far: Length = 2.5,
    resolution: Resolution = 16,
) -> Shading:
    """Mix new and old shading far from the face, which the face's light says little about.

    Args:
        estimated, relit: both spread over the whole picture; H x W or H x W x 3.
        scene: `scene.background` is the share of the new shading far away.
        near, far: distances from the face, in inter-ocular distances, between which the share falls from 1 to that.

    Returns:
        `relit` at the face; further away estimated + share * (relit - estimated).
    """
    if scene.background == 1 or estimated is relit:
        return relit
    unit = max(landmarks.interocular, 1e-3)
    scale = min(1.0, resolution / unit)
    small_mask = _shrunk(mask, scale)
    core = _core(small_mask)
    if core is None:
        return relit
    _, distance = _nearest(core)
    fall = _smooth_step((distance / (unit * scale) - near) / max(far - near, 1e-3))
    share = _enlarged(1 - (1 - scene.background) * fall, mask.shape)
    if estimated.ndim < relit.ndim:
        estimated = estimated[..., None]
    mixed: Shading = estimated + share.reshape(*share.shape, *[1] * (relit.ndim - 2)) * (relit - estimated)
    return mixed


def _shrunk(values: FloatArray, scale: float) -> FloatArray:
    """Area means in a smaller copy."""
    import cv2

    height, width = (max(1, round(n * scale)) for n in values.shape[:2])
    return np.asarray(cv2.resize(values, (width, height), interpolation=cv2.INTER_AREA), np.float32)


def _core(weight: FloatArray) -> NDArray[np.bool_] | None:
    """The pixels that others copy: well inside the mask, or its best where it is faint everywhere; None: no mask."""
    most = float(weight.max())
    return weight >= min(0.5, most) if most > 1e-12 else None


def _nearest(core: NDArray[np.bool_]) -> tuple[NDArray[np.intp], FloatArray]:
    """The place of each pixel's nearest core pixel, counted row by row, and the distance to it in pixels."""
    import cv2

    outside = (~core).astype(np.uint8)
    distance, labels = cv2.distanceTransformWithLabels(outside, cv2.DIST_L2, 5, labelType=cv2.DIST_LABEL_PIXEL)
    place = np.zeros(int(labels.max()) + 1, np.intp)
    place[labels[core]] = np.flatnonzero(core)
    return place[labels], np.asarray(distance, np.float32)


def _smooth_step(t: FloatArray) -> FloatArray:
    t = np.clip(t, 0, 1)
    return t * t * (3 - 2 * t)


def _enlarged(values: FloatArray, shape: tuple[int, ...]) -> FloatArray:
    import cv2

    return np.asarray(cv2.resize(values, (shape[1], shape[0]), interpolation=cv2.INTER_LINEAR), np.float32)
