"""Where face, hair and background are to be expected, before any pixel is looked at.

Four classes: background is the backdrop beside the head and the clothes below it, since a dark suit says nothing about
what stands behind dark hair. Scores are piecewise linear in distances from the solids of `head_shape`, in inter-ocular
distances; the numbers were set by looking at portraits, and matter only where color and texture say little.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.head_shape import CHIN, EYE_LINE, Points, cranium, ears, neck, pose_of
from graphface.nodes.landmark_schemes import BROWS, EYES, IBUG68_IN_FACEMESH468, OUTER_LIPS
from graphface.nodes.masks.geometric import filled
from graphface.nodes.masks.window import Window
from graphface.nodes.types import FloatArray, Landmarks

FACE, HAIR, BACKDROP, CLOTHES = range(4)


@dataclass(frozen=True)
class Layout:
    """Geometry of one face at working size, all h x w.

    `outline`, `head`, `neck`: signed distances to the landmarks' outline, to face + cranium + ears and to the neck, in
    inter-ocular distances, positive outside. `right`, `high`: position in the upright face's axes (see `Pose.locate`).
    `features`: brows, eyes and mouth, which are no skin.
    """

    outline: FloatArray
    head: FloatArray
    neck: FloatArray
    right: FloatArray
    high: FloatArray
    features: NDArray[np.bool_]


def layout_of(landmarks: Landmarks, window: Window) -> Layout:
    """The geometry of a face in a window."""
    pose = pose_of(landmarks)
    shape = (window.height, window.width)
    unit = max(1e-3, landmarks.interocular * window.scale)  # in this order NaN gives way
    points = window.inside(landmarks.points[:, :2].astype(np.float64))
    outline = filled([_hull(points)], shape)
    solids = [window.inside(p) for p in (cranium(pose), *ears(pose))]
    right, high = np.broadcast_arrays(*pose.locate(*window.positions()))
    return Layout(
        outline=_signed_distance(outline, unit),
        head=_signed_distance(np.maximum(outline, filled(solids, shape)), unit),
        neck=_signed_distance(filled([window.inside(neck(pose))], shape), unit),
        right=right,
        high=high,
        features=_features(points, landmarks.scheme, shape, unit),
    )


def log_prior(layout: Layout) -> FloatArray:
    """log p(class) before looking, float32 h x w x 4, in the order FACE, HAIR, BACKDROP, CLOTHES."""
    high, side = layout.high, np.abs(layout.right)
    below_chin = np.maximum(CHIN - high, 0)
    above_eyes = np.maximum(high - EYE_LINE, 0)

    scalp = np.where(high > EYE_LINE, np.minimum(layout.head, 0.0), 1.0)
    skin = np.minimum(layout.outline, layout.neck + 0.1 + 0.25 * below_chin)
    ear = np.where(high > EYE_LINE + 0.25, 1.0, layout.head + 0.05)
    fall = np.where(below_chin > 0, 3.5, 6.0)  # shoulders may be bare
    face = 2.0 - fall * np.clip(np.minimum(skin, ear), 0, 1) - 3.0 * above_eyes * (layout.outline > 0)
    face = np.where(scalp < 0, np.maximum(face, -1.0), face)

    # Long hair falls beside the face and onto the shoulders; above, it stays near the skull.
    beside = np.where(below_chin > 0, np.maximum(side - 1.1, 0), np.maximum(layout.head, 0))
    hair = 1.5 - np.where(high > EYE_LINE, 2.6, 1.5) * beside - 0.5 * below_chin
    inner = np.maximum(-layout.outline, 0)
    hair -= np.where(high > EYE_LINE + 0.2, 4.0, 12.0) * inner
    hair -= 5.0 * np.clip(1.2 * (0.75 - side), 0, 1) * ((layout.neck < 0) & (layout.outline > 0))

    body = np.minimum(layout.head, layout.neck + 0.05)
    backdrop = np.clip(0.5 + 3.0 * body, -4, 1.5) - 1.5 * np.clip(below_chin * 2 - side, 0, 1.5)
    clothes = np.clip(-3 + 5.0 * (below_chin - 0.35 + 0.15 * np.minimum(side, 1)), -8, 2.0)
    clothes -= np.where(layout.neck < 0, 1.0, 0.0) * np.clip(1.2 - below_chin * 1.5, 0, 1)
    scores = np.stack([face, hair, backdrop, clothes], axis=2).astype(np.float32)
    return scores - log_sum_exp(scores)


def log_sum_exp(scores: FloatArray) -> FloatArray:
    """log of the sum of exponentials over the last axis, which is kept."""
    top = scores[..., :1]
    for k in range(1, scores.shape[-1]):
        top = np.maximum(top, scores[..., k : k + 1])  # several times faster than `max` over so short an axis
    total = np.exp(scores - top) @ np.ones((scores.shape[-1], 1), scores.dtype)
    return np.asarray(top + np.log(total), np.float32)


def _features(points: Points, scheme: str, shape: tuple[int, int], unit: float) -> NDArray[np.bool_]:
    import cv2

    if scheme == "facemesh468":
        points = points[IBUG68_IN_FACEMESH468]
    half = 17 + len(BROWS) // 2
    brows = [points[17:half], points[half : 17 + len(BROWS)]]
    eyes = [points[36 : 36 + len(EYES) // 2], points[36 + len(EYES) // 2 : 36 + len(EYES)]]
    lips = points[48 : 48 + len(OUTER_LIPS)]
    nostrils = points[31:36]
    marks = filled([_hull(p) for p in (*brows, *eyes, lips, nostrils)], shape)
    grown = cv2.dilate(marks, np.ones((2 * max(1, round(0.06 * unit)) + 1,) * 2, np.uint8))
    return np.asarray(grown > 0)


def _signed_distance(mask: FloatArray, unit: float) -> FloatArray:
    """Distance to the edge of a mask of 0 and 1 in units, positive outside; +-9 where it has no edge in sight."""
    import cv2

    inside = mask > 0.5
    if inside.all() or not inside.any():
        return np.full(mask.shape, -9 if inside.any() else 9, np.float32)
    to_mask, to_rest = (cv2.distanceTransform(m.astype(np.uint8), cv2.DIST_L2, 5) for m in (~inside, inside))
    return np.asarray((to_mask - to_rest) / unit, np.float32)


def _hull(points: Points) -> Points:
    import cv2

    if not np.isfinite(points).all():
        return np.zeros((0, 2))
    hull: Points = cv2.convexHull(points.astype(np.float32)).reshape(-1, 2).astype(np.float64)
    return hull
