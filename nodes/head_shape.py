"""The rest of the head from the landmarks of the face: cranium, ears and neck as simple solids.

The built-in model ends at the hairline, the jaw and the ears. The mean face is posed onto the landmarks (position,
rotation and one scale: a weak perspective), and solids in the mean face's frame are posed with it. Their sizes are
adult means from anthropometry, divided by the distance between the outer eye corners (9.0 cm): head breadth 15.2 cm,
head length 19.4 cm, eye line to crown 11.3 cm, ear length 6.3 cm, neck breadth 11.5 cm (after Farkas, Anthropometry of
the Head and Face, 1994, rounded). A solid's outline is the convex hull of its projected points.

Frame of the mean face: unit = distance between the outer eye corners, x to the picture's right, y up, z to the viewer,
origin at the mean of the 468 points; the eye line is at y = 0.34, the chin at -0.90.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import Any

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
"""Center and half axes of an ellipsoid through glabella, crown and the sides of the head."""


EAR = ((0.86, 0.13, -0.80), (0.15, 0.36, 0.18))
"""Center and half axes of the left ear; the right one is its mirror image."""


NECK_RADIUS, NECK_DEPTH, NECK_TOP, NECK_BOTTOM = 0.62, -0.80, -0.35, -1.75
"""A cylinder: radius, z of its axis, and y of its ends."""


@dataclass(frozen=True)
class Pose:
    """Mean-face coordinates to pixels: pixel = offset + scale * (rotation @ point)[:2], with y turned downwards."""

    rotation: Points
    scale: float
    offset: Points

    @property
    def up(self) -> Points:
        """The head's up axis in the picture (2,), y up, of length 1; (0, 1) where the axis points at the viewer."""
        up = self.rotation[:2, 1]
        length = float(np.hypot(*up))
        return up / length if length > 1e-3 else np.array([0.0, 1.0])

    def project(self, points: Points) -> Points:
        """(n, 3) to pixels (n, 2)."""
        rotated = points @ self.rotation.T[:, :2]
        pixels: Points = self.offset + self.scale * rotated * (1, -1)
        return pixels

    def locate(self, x: NDArray[np.float32], y: NDArray[np.float32]) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
        """Pixels to the upright face's own axes: right and up from its origin, unit = outer eye corners' distance.

        Only the face's roll is removed: a head turned to the side keeps its foreshortening.
        """
        up_x, up_y = (np.float32(component) for component in self.up)
        floor = max(self.scale, 1e-3)
        dx, dy = (x - self.offset[0]) / floor, (self.offset[1] - y) / floor
        return up_y * dx - up_x * dy, up_x * dx + up_y * dy


def mean_face(scheme: str) -> NDArray[np.float32]:
    """The landmarks of the mean face, (n, 3) for the scheme's n points, in the mean face's frame.

    >>> mean_face("ibug68").shape
    (68, 3)
    """
    mean = facemesh_topology().mean
    return mean[IBUG68_IN_FACEMESH468] if scheme == "ibug68" else mean


def pose_of(landmarks: Landmarks) -> Pose:
    """The weak perspective that maps the mean face onto the landmarks with the least squared distance in the picture.

    It is fitted to x and y only, so landmarks need no depth. The affine fit's two rows are replaced by the nearest pair
    of orthogonal rows of equal length. Landmarks that are not finite give a pose of scale 0.001, with a warning.
    """
    mean = mean_face(landmarks.scheme).astype(np.float64)
    pixels = landmarks.points[:, :2].astype(np.float64) * (1, -1)
    if not np.isfinite(pixels).all():
        warn("masks: landmarks are not finite; the head is placed at the picture's corner, of size 0")
        return Pose(np.eye(3), 1e-3, np.zeros(2))
    center, middle = mean.mean(axis=0), pixels.mean(axis=0)
    shape = mean - center
    spread = shape.T @ shape
    affine = np.linalg.solve(spread + 1e-9 * np.trace(spread) * np.eye(3), shape.T @ (pixels - middle)).T
    left, lengths, right = np.linalg.svd(affine, full_matrices=False)
    scale = max(float(lengths.mean()), 1e-3)
    rows = left @ right
    rotation = np.vstack([rows, np.cross(rows[0], rows[1])])
    offset = middle - scale * rows @ center
    return Pose(rotation, scale, offset * (1, -1))


def cranium(pose: Pose) -> Points:
    """Outline of the skull above the ears, pixels (n, 2)."""
    return convex_hull(pose.project(_ellipsoid(*CRANIUM)))


def ears(pose: Pose) -> list[Points]:
    """Outlines of both ears, pixels; a hidden ear lies inside the head's outline."""
    (x, y, z), half = EAR
    return [convex_hull(pose.project(_ellipsoid((side * x, y, z), half))) for side in (-1, 1)]


def neck(pose: Pose) -> Points:
    """Outline of the neck from under the jaw to the collar bone, pixels (n, 2)."""
    angle = np.linspace(0, 2 * np.pi, 48, endpoint=False)
    ring = np.stack([np.sin(angle), np.zeros_like(angle), np.cos(angle)], axis=1) * NECK_RADIUS
    ends = [ring + np.array([0, height, NECK_DEPTH]) for height in (NECK_TOP, NECK_BOTTOM)]
    return convex_hull(pose.project(np.concatenate(ends)))


def _ellipsoid(center: tuple[float, float, float], half: tuple[float, float, float]) -> Points:
    points: Points = _sphere() * np.array(half) + np.array(center)
    return points


@cache
def _sphere(count: int = 600) -> Points:
    """Points spread evenly over the unit sphere: a Fibonacci spiral."""
    index = np.arange(count) + 0.5
    z = 1 - 2 * index / count
    angle = np.pi * (1 + 5**0.5) * index
    radius = np.sqrt(np.maximum(1 - z * z, 0))
    return np.stack([radius * np.cos(angle), radius * np.sin(angle), z], axis=1)


def convex_hull(points: NDArray[np.floating[Any]]) -> Points:
    """Corners of the convex hull, float64 (m, 2), of points (n, 2); none where some point is not finite.

    >>> len(convex_hull(np.array([[0, 0], [4, 0], [0, 4], [1, 1]])))
    3
    """
    import cv2

    if not np.isfinite(points).all():
        return np.zeros((0, 2))
    hull: Points = cv2.convexHull(np.ascontiguousarray(points, np.float32)).reshape(-1, 2).astype(np.float64)
    return hull
