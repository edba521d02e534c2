"""Where the rest of the head lies, told from the points of the face: cranium, ears and neck as simple solids.

The built-in model ends at the hairline, the jaw and the ears. The mean face is posed onto the landmarks (position,
turn and one scale: a weak perspective), and solids that stand in the mean face's frame are posed with it. Their sizes
are adult means from anthropometry, divided by the distance between the outer eye corners (9.0 cm): head breadth
15.2 cm, head length 19.4 cm, eye line to crown 11.3 cm, ear length 6.3 cm, neck breadth 11.5 cm (after Farkas,
Anthropometry of the Head and Face, 1994, rounded). A solid's outline is the convex hull of its projected points.

Frame of the mean face: unit = distance between the outer eye corners, x to the picture's right, y up, z to the viewer,
origin at the mean of the 468 points; the eye line is at y = 0.34, the chin at -0.90.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray

from graphface import warn
from graphface.nodes.landmark_schemes import IBUG68_IN_FACEMESH468
from graphface.nodes.morphable.topology import facemesh_topology
from graphface.nodes.types import Landmarks

Points = NDArray[np.float64]


EYE_LINE, CHIN = 0.34, -0.90
"""Heights in the mean face's frame."""


CRANIUM = ((0.0, 0.57, -0.92), (0.86, 1.02, 1.05))
"""Centre and half axes of an ellipsoid through glabella, crown and the sides of the head."""


EAR = ((0.86, 0.13, -0.80), (0.15, 0.36, 0.18))
"""Centre and half axes of the left ear; the right one is its mirror image."""


NECK_RADIUS, NECK_DEPTH, NECK_TOP, NECK_BOTTOM = 0.62, -0.80, -0.35, -1.75
"""A cylinder: radius, z of its axis, and y of its ends."""


@dataclass(frozen=True)
class Pose:
    """Mean-face coordinates to pixels: pixel = offset + scale * (rotation @ point)[:2], with y turned downwards."""

    rotation: Points
    scale: float
    offset: Points

    def project(self, points: Points) -> Points:
        """(n, 3) to pixels (n, 2)."""
        turned = points @ self.rotation.T[:, :2]
        pixels: Points = self.offset + self.scale * turned * (1, -1)
        return pixels

    def locate(self, x: NDArray[np.float32], y: NDArray[np.float32]) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
        """Pixels to the upright face's own axes: right and up from its origin, unit = outer eye corners' distance.

        The face's roll is taken out and nothing else: a turned head keeps its foreshortening.
        """
        up = self.rotation[:2, 1]
        length = float(np.hypot(*up))
        up_x, up_y = up / length if length > 1e-3 else np.array([0.0, 1.0])
        floor = max(self.scale, 1e-3)
        right, high = (x - self.offset[0]) / floor, (self.offset[1] - y) / floor
        return np.float32(up_y) * right - np.float32(up_x) * high, np.float32(up_x) * right + np.float32(up_y) * high


def pose_of(landmarks: Landmarks) -> Pose:
    """The weak perspective that lays the mean face onto the landmarks best, by least squares in the picture.

    Fitted to x and y only, so landmarks without depth will do. The affine fit's two rows are replaced by the nearest
    pair of orthogonal rows of equal length.
    """
    mean = facemesh_topology().mean.astype(np.float64)
    if landmarks.scheme == "ibug68":
        mean = mean[IBUG68_IN_FACEMESH468]
    pixels = landmarks.points[:, :2].astype(np.float64) * (1, -1)
    if not np.isfinite(pixels).all():
        warn("masks: landmarks are not finite; the head is placed at the picture's corner, of size 0")
        return Pose(np.eye(3), 1e-3, np.zeros(2))
    centre, middle = mean.mean(axis=0), pixels.mean(axis=0)
    shape = mean - centre
    spread = shape.T @ shape
    affine = np.linalg.solve(spread + 1e-9 * np.trace(spread) * np.eye(3), shape.T @ (pixels - middle)).T
    left, lengths, right = np.linalg.svd(affine, full_matrices=False)
    scale = max(float(lengths.mean()), 1e-3)
    rows = left @ right
    rotation = np.vstack([rows, np.cross(rows[0], rows[1])])
    offset = middle - scale * rows @ centre
    return Pose(rotation, scale, offset * (1, -1))


def cranium(pose: Pose) -> Points:
    """Outline of the skull above the ears, pixels (n, 2)."""
    return _hull(pose.project(_ellipsoid(*CRANIUM)))


def ears(pose: Pose) -> list[Points]:
    """Outlines of both ears, pixels; hidden ones fall inside the head's outline."""
    (x, y, z), half = EAR
    return [_hull(pose.project(_ellipsoid((side * x, y, z), half))) for side in (-1, 1)]


def neck(pose: Pose) -> Points:
    """Outline of the neck from under the jaw to the collar bone, pixels (n, 2)."""
    angle = np.linspace(0, 2 * np.pi, 48, endpoint=False)
    ring = np.stack([np.sin(angle), np.zeros_like(angle), np.cos(angle)], axis=1) * NECK_RADIUS
    ends = [ring + np.array([0, height, NECK_DEPTH]) for height in (NECK_TOP, NECK_BOTTOM)]
    return _hull(pose.project(np.concatenate(ends)))


def _ellipsoid(centre: tuple[float, float, float], half: tuple[float, float, float]) -> Points:
    points: Points = _sphere() * np.array(half) + np.array(centre)
    return points


@cache
def _sphere(count: int = 600) -> Points:
    """Points spread evenly over the unit sphere: a Fibonacci spiral."""
    index = np.arange(count) + 0.5
    z = 1 - 2 * index / count
    angle = np.pi * (1 + 5**0.5) * index
    radius = np.sqrt(np.maximum(1 - z * z, 0))
    return np.stack([radius * np.cos(angle), radius * np.sin(angle), z], axis=1)


def _hull(pixels: Points) -> Points:
    import cv2

    hull: Points = cv2.convexHull(pixels.astype(np.float32)).reshape(-1, 2).astype(np.float64)
    return hull
