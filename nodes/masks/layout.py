"""Geometry of one face at working size: signed distances to the parts of the head, and positions in the face's axes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.head_shape import Points, convex_hull, cranium, ears, neck, pose_of
from graphface.nodes.landmark_schemes import BROWS, EYES, IBUG68_IN_FACEMESH468, OUTER_LIPS
from graphface.nodes.masks.polygons import filled
from graphface.nodes.masks.window import Window
from graphface.nodes.types import FloatArray, Landmarks


@dataclass(frozen=True)
class Layout:
    """Maps of one face, all h x w; lengths in inter-ocular distances.

    `outline`, `head`, `neck`: signed distances to the landmarks' outline, to face + cranium + ears, and to the neck,
    positive outside. `right`, `up`: position in the upright face's axes (see `Pose.locate`). `features`: brows, eyes,
    nostrils and mouth, which are not skin.
    """

    outline: FloatArray
    head: FloatArray
    neck: FloatArray
    right: FloatArray
    up: FloatArray
    features: NDArray[np.bool_]


def layout_of(landmarks: Landmarks, window: Window) -> Layout:
    """The geometry of a face in a window."""
    pose = pose_of(landmarks)
    shape = (window.height, window.width)
    unit = max(1e-3, landmarks.interocular * window.scale)  # in this order a NaN becomes 1e-3
    points = window.to_window(landmarks.points[:, :2].astype(np.float64))
    outline = filled([convex_hull(points)], shape)
    solids = [window.to_window(p) for p in (cranium(pose), *ears(pose))]
    right, up = np.broadcast_arrays(*pose.locate(*window.positions()))
    return Layout(
        outline=_signed_distance(outline, unit),
        head=_signed_distance(np.maximum(outline, filled(solids, shape)), unit),
        neck=_signed_distance(filled([window.to_window(neck(pose))], shape), unit),
        right=right,
        up=up,
        features=_features(points, landmarks.scheme, shape, unit),
    )


def _features(points: Points, scheme: str, shape: tuple[int, int], unit: float) -> NDArray[np.bool_]:
    import cv2

    if scheme == "facemesh468":
        points = points[IBUG68_IN_FACEMESH468]
    half = 17 + len(BROWS) // 2
    brows = [points[17:half], points[half : 17 + len(BROWS)]]
    eyes = [points[36 : 36 + len(EYES) // 2], points[36 + len(EYES) // 2 : 36 + len(EYES)]]
    lips = points[48 : 48 + len(OUTER_LIPS)]
    nostrils = points[31:36]
    marks = filled([convex_hull(p) for p in (*brows, *eyes, lips, nostrils)], shape)
    grown = cv2.dilate(marks, np.ones((2 * max(1, round(0.06 * unit)) + 1,) * 2, np.uint8))
    return np.asarray(grown > 0)


def _signed_distance(mask: FloatArray, unit: float) -> FloatArray:
    """Distance to the edge of a mask of 0 and 1 in units, positive outside; ±9 where the mask has no edge."""
    import cv2

    inside = mask > 0.5
    if inside.all() or not inside.any():
        return np.full(mask.shape, -9 if inside.any() else 9, np.float32)
    to_mask, to_rest = (cv2.distanceTransform(m.astype(np.uint8), cv2.DIST_L2, 5) for m in (~inside, inside))
    return np.asarray((to_mask - to_rest) / unit, np.float32)
