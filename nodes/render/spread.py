"""Shading beyond the face, where there is no geometry (paper, section 3.1, "compositing non-face pixels").

Each pixel outside the face takes the shading of its nearest face pixel, and the result is smoothed. The estimated and
the new shading go through the same linear operation: where they agree on the face they agree everywhere, so an
unchanged light changes no pixel, and along the mask's edge there is nothing to see.

Nearest-pixel fields are streaky and smooth fields need no resolution, so this runs on a small copy in which the
inter-ocular distance has `resolution` pixels; on the face itself the full-resolution shading is kept.
"""

from __future__ import annotations

from typing import Annotated

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from graphface import node, warn
from graphface.nodes.detail.rendering import in_three_channels
from graphface.nodes.render.scene import Scene
from graphface.nodes.strips import by_strips
from graphface.nodes.types import FloatArray, Landmarks, Mask, Shading, Surface

Length = Annotated[float, Field(gt=0, le=10)]
Resolution = Annotated[int, Field(ge=8, le=256)]


@node("render.spread")
def spread(
    shading: Shading,
    mask: Mask,
    surface: Surface,
    landmarks: Landmarks,
    *,
    smoothing: Length = 0.25,
    resolution: Resolution = 32,
) -> Shading:
    """A shading known on the face, continued over the whole picture.

    Args:
        shading: H x W or H x W x 3, valid where `surface` covers the picture.
        mask: the face; between 0 and 1 the shading goes over into the continued one.
        smoothing: width of the blur beside the face, in inter-ocular distances; it triples with distance.
        resolution: pixels per inter-ocular distance of the small copy that is worked on.

    Returns:
        float32 of the shape of `shading`: `shading` where the mask is 1, defined everywhere.
    """
    import cv2

    weight = mask * (surface.coverage > 0)
    scale = min(1.0, resolution / max(landmarks.interocular, 1e-3))
    small_weight = _shrunk(weight, scale)
    core = _core(small_weight)
    if core is None:
        warn("render.spread: the mask is empty; the shading is taken as 0 everywhere, so no light changes the picture")
        return np.zeros_like(shading)
    extra = [1] * (shading.ndim - 2)
    small_weight = small_weight.reshape(*small_weight.shape, *extra)
    weighted = _like(weight, shading) * shading
    small = (_shrunk(weighted, scale) / np.maximum(small_weight, 1e-12)).astype(np.float32, copy=False)
    nearest, distance = _nearest(small, core)
    blur = max(smoothing * landmarks.interocular * scale, 0.5)
    near, far = (
        np.asarray(cv2.GaussianBlur(nearest, (0, 0), sigma, borderType=cv2.BORDER_REPLICATE), np.float32)
        for sigma in (blur, 3 * blur)
    )
    t = _smooth_step(distance / (4 * blur)).reshape(*distance.shape, *extra)
    beyond = _enlarged(near + (far - near) * t, mask.shape)

    def join(rows: slice) -> None:
        inside = shading[rows] - beyond[rows]
        inside *= _like(weight[rows], shading)
        beyond[rows] += inside

    by_strips(join, beyond.shape)
    return beyond


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
    _, distance = _nearest(small_mask, core)
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


def _nearest(values: FloatArray, core: NDArray[np.bool_]) -> tuple[FloatArray, FloatArray]:
    """Each pixel's value from its nearest core pixel, and the distance to it."""
    import cv2

    outside = (~core).astype(np.uint8)
    distance, labels = cv2.distanceTransformWithLabels(outside, cv2.DIST_L2, 5, labelType=cv2.DIST_LABEL_PIXEL)
    of_label = np.zeros((int(labels.max()) + 1, *values.shape[2:]), np.float32)
    of_label[labels[core]] = values[core]
    return of_label[labels], np.asarray(distance, np.float32)


def _smooth_step(t: FloatArray) -> FloatArray:
    t = np.clip(t, 0, 1)
    return t * t * (3 - 2 * t)


def _enlarged(values: FloatArray, shape: tuple[int, ...]) -> FloatArray:
    import cv2

    return np.asarray(cv2.resize(values, (shape[1], shape[0]), interpolation=cv2.INTER_LINEAR), np.float32)
