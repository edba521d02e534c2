"""Lamps in the background: they give light and take none."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from graphface import node
from graphface.nodes.blur import blurred
from graphface.nodes.color import channel_mean
from graphface.nodes.disc import disc
from graphface.nodes.face_scale import face_scale
from graphface.nodes.head_shape import CHIN, pose_of
from graphface.nodes.smoothstep import smoothstep
from graphface.nodes.types import Image, Landmarks, Mask, Segmentation

_GLOW = (0.55, 0.85)
"""Intensities between which the surroundings of a lamp begin to count as its glow."""

_MOST = 256
"""Spots that are looked at, the largest first: a picture of a thousand specks has no lamps."""

_SHOULDERS = 2.5
"""Half of their width with a margin, in inter-ocular distances."""

_STRAND = 0.12
"""Width, in inter-ocular distances, up to which something dark in front of a wall is not the wall."""

_LEAST_PIXELS = 4
"""Of the surroundings of a spot, to tell their brightness."""


@node("render.lamps")
def lamps(
    photo: Image,
    labels: Segmentation,
    landmarks: Landmarks,
    head: Mask | None = None,
    *,
    blown: Annotated[float, Field(gt=0, le=1)] = 0.97,
    largest: Annotated[float, Field(ge=0, le=100)] = 1.0,
    contrast: Annotated[float, Field(ge=0, le=1)] = 0.25,
    glow: Annotated[float, Field(ge=0, le=2)] = 0.1,
    resolution: Annotated[int, Field(ge=8, le=1024)] = 96,
) -> Mask:
    """Small blown spots of the background that stand out from their surroundings: lamps, candles, the sun, reflections.

    Args:
        head: the head by its geometry, H x W; a highlight on it is no lamp, whatever its label.
        blown: least value of every channel in a spot.
        largest: area up to which a spot is a lamp and not a white wall or a window, in squares of the inter-ocular
            distance.
        contrast: how much darker than white the darkest quarter of its surroundings is at least.
        glow: width of the bright rim that belongs to a lamp, in inter-ocular distances.
        resolution: pixels per inter-ocular distance of the copy on which spots are looked at.

    Returns:
        H x W in [0, 1]: the share of a pixel that is a source of light.
    """
    import cv2

    copy = face_scale(landmarks, photo.pixels.shape, resolution)
    background, nothing = labels.background, np.zeros(photo.pixels.shape[:2], np.float32)
    blown_out = np.minimum(np.minimum(photo.pixels[..., 0], photo.pixels[..., 1]), photo.pixels[..., 2]) >= blown
    blown_out &= background > 0.5
    if head is not None:
        blown_out &= head == 0
    if not blown_out.any():
        return nothing
    spots = (copy.down(blown_out.astype(np.float32)) > 0.5).astype(np.uint8)
    intensity, wall = copy.down(channel_mean(photo.pixels)), copy.down(background)
    # Without strands: between curls a white wall would stand out from the dark hair about it.
    behind = cv2.morphologyEx(intensity, cv2.MORPH_CLOSE, disc(max(1, _STRAND * copy.interocular / 2)))
    count, found, boxes, middles = cv2.connectedComponentsWithStats(spots)
    numbers, extents = np.asarray(found, np.int32), np.asarray(boxes, np.int32)
    areas = extents[:, cv2.CC_STAT_AREA]
    small = np.flatnonzero(areas <= max(largest * copy.interocular**2, 1))
    small = small[(small > 0) & ~_on_body(np.asarray(middles[small], np.float64) / copy.scale, landmarks)]
    candidates = small[np.argsort(-areas[small], kind="stable")][:_MOST]
    kept = np.zeros(count, np.float32)
    for number in candidates:
        window, reach = _around(extents[number])
        ring = _grown(numbers[window] == number, reach) & (spots[window] == 0) & (wall[window] > 0.5)
        around = behind[window][ring]
        kept[number] = around.size > _LEAST_PIXELS and np.percentile(around, 25) < 1 - contrast
    if not kept.any():
        return nothing
    width = glow * copy.interocular
    grown = cv2.dilate(kept[numbers], disc(max(1, width / 2)))
    soft = blurred(np.asarray(grown, np.float32), max(width / 4, 0.5))
    soft *= smoothstep((intensity - np.float32(_GLOW[0])) / np.float32(_GLOW[1] - _GLOW[0]))
    return np.asarray(copy.up(soft) * background, np.float32)


def _on_body(points: NDArray[np.float64], landmarks: Landmarks) -> NDArray[np.bool_]:
    """Whether points (n, 2) lie below the face and within the width of the shoulders: white collars are no lamps."""
    pose = pose_of(landmarks)
    right, up = pose.locate(*np.asarray(points, np.float32).T)
    return np.asarray((up < CHIN) & (np.abs(right) < _SHOULDERS))


def _around(extent: NDArray[np.int32]) -> tuple[tuple[slice, slice], int]:
    """The part of the picture around a spot, by OpenCV's left, top, width, height, and by how much it is wider."""
    left, top, width, height = (int(value) for value in extent[:4])
    reach = round(0.35 * max(width, height)) + 4
    rows = slice(max(0, top - reach), top + height + reach)
    return (rows, slice(max(0, left - reach), left + width + reach)), reach


def _grown(spot: NDArray[np.bool_], reach: int) -> NDArray[np.bool_]:
    """A spot and what is nearer to it than `reach` pixels."""
    import cv2

    return np.asarray(cv2.dilate(spot.astype(np.uint8), disc(reach - 1)) > 0)
