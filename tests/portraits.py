"""A drawn head whose labels are known, for tests that must not need photographs."""

from __future__ import annotations

import numpy as np

from graphface.nodes.head_shape import Pose, cranium, ears, neck
from graphface.nodes.morphable.topology import facemesh_topology
from graphface.nodes.types import FloatArray, Image, Landmarks, Surface

SKIN, HAIR, BACKDROP, CLOTHES = (0.80, 0.60, 0.50), (0.20, 0.13, 0.08), (0.55, 0.65, 0.75), (0.10, 0.12, 0.30)


def pose_at(x: float, y: float, interocular: float, roll: float = 0.0) -> Pose:
    """An upright frontal head (turned by `roll` radians in the picture) about a pixel."""
    c, s = np.cos(roll), np.sin(roll)
    return Pose(np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]]), interocular, np.array([x, y], np.float64))


def landmarks_at(x: float, y: float, interocular: float, roll: float = 0.0) -> Landmarks:
    """The mean face's 468 points about a pixel."""
    mean = facemesh_topology().mean.astype(np.float64)
    pixels = pose_at(x, y, interocular, roll).project(mean)
    return Landmarks(np.concatenate([pixels, mean[:, 2:] * interocular], axis=1).astype(np.float32), "facemesh468")


def surface_of(landmarks: Landmarks, shape: tuple[int, int]) -> Surface:
    """Coverage of the landmarks' outline; what else a surface has is empty."""
    import cv2

    coverage = np.zeros(shape, np.uint8)
    hull = cv2.convexHull(landmarks.points[:, :2].copy()).reshape(-1, 2)
    cv2.fillConvexPoly(coverage, np.round(hull).astype(np.int32), 1)
    flat = np.zeros((*shape, 3), np.float32)
    return Surface(flat, flat[..., 0], coverage.astype(np.float32), np.full(shape, -1, np.int32), flat)


def portrait(
    side: int = 200, *, hair: tuple[float, float, float] = HAIR, noise: float = 0.02, seed: int = 0
) -> tuple[Image, Landmarks, FloatArray]:
    """A photo, its landmarks, and the true labels H x W (0 face, 1 hair, 2 background)."""
    import cv2

    unit = side / 4.5
    pose = pose_at(side / 2, side / 2, unit)
    landmarks = landmarks_at(side / 2, side / 2, unit)
    pixels = np.empty((side, side, 3), np.float32)
    pixels[:] = BACKDROP
    labels = np.full((side, side), 2, np.int32)

    def paint(outline: np.ndarray, color: tuple[float, float, float], label: int) -> None:
        inside = np.zeros((side, side), np.uint8)
        cv2.fillConvexPoly(inside, np.round(outline).astype(np.int32), 1)
        pixels[inside > 0] = color
        labels[inside > 0] = label

    paint(np.array([[0.1, 0.85], [0.9, 0.85], [1.0, 1.0], [0.0, 1.0]]) * side, CLOTHES, 2)
    paint(neck(pose), SKIN, 0)
    for ear in ears(pose):
        paint(ear, SKIN, 0)
    paint(cranium(pose), hair, 1)
    paint(cv2.convexHull(landmarks.points[:, :2].copy()).reshape(-1, 2), SKIN, 0)
    rng = np.random.default_rng(seed)
    pixels += rng.normal(0, noise, pixels.shape).astype(np.float32) if noise else 0
    return Image(np.clip(pixels, 0, 1)), landmarks, labels


def eyes_apart(pixels: float) -> Landmarks:
    """Landmarks that say nothing but the inter-ocular distance."""
    points = np.zeros((468, 3), np.float32)
    points[263, 0] = pixels
    return Landmarks(points, "facemesh468")
