"""Pose of a rigid shape from its projection, in closed form: the initial pose of a fit."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Pose:
    """Model to camera frame: `scale` (pixels) times `rotation` (3, 3), plus `offset` (2,) in the picture, y up.

    `thinness`: ratio of the principal deviations of the points in the picture (1 for a disc, infinity for a line).
    """

    rotation: Array
    scale: float
    offset: Array
    thinness: float = 1.0


def closed_form(shape: Array, points: Array, *, rounds: int = 8, ridge: float = 1e-6) -> Pose:
    """The scaled-orthographic pose that maps `shape` (n, 3) to `points` (n, 2; y up), robust to outliers.

    The best affine camera is a linear problem; the scaled rotation nearest to it is its polar factor. Points of large
    error get a smaller weight and the problem is solved again (weights of Geman and McClure, scale from the median).

    Args:
        rounds: of reweighting.
        ridge: relative to the shape's spread; makes flat or coincident points solvable.
    """
    weights = np.ones(len(shape))
    rotation, scale, offset = np.eye(3), 1.0, np.zeros(2)
    for _ in range(rounds):
        total = max(float(weights.sum()), 1e-12)
        middle, center = weights @ shape / total, weights @ points / total
        weighted = (shape - middle) * weights[:, None]
        scatter = weighted.T @ (shape - middle)
        floor = ridge * max(float(np.trace(scatter)), 1e-12)
        affine = np.linalg.solve(scatter + floor * np.eye(3), weighted.T @ (points - center)).T
        rotation, scale = _nearest_rotation(np.asarray(affine, np.float64))
        offset = center - scale * rotation[:2] @ middle
        error = np.linalg.norm(points - offset - scale * shape @ rotation[:2].T, axis=1)
        spread = max(3 * float(np.median(error)), 1e-3 * scale, 1e-12)
        weights = 1 / np.square(1 + np.square(error / spread))
    sizes = np.linalg.svd((points - np.median(points, axis=0)) * np.sqrt(weights)[:, None], compute_uv=False)
    return Pose(rotation, scale, offset, float(sizes[0] / max(sizes[1], 1e-12 * sizes[0], 1e-300)))


def rotated(rotation: Array, vector: Array) -> Array:
    """`rotation` followed by a rotation about `vector` (3,), whose length is the angle in radians (Rodrigues).

    >>> rotated(np.eye(3), np.array([0, 0, np.pi / 2])).round(6).tolist()
    [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]
    """
    angle = float(np.linalg.norm(vector))
    if angle < 1e-12:
        return rotation
    x, y, z = vector / angle
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    matrix = np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross
    u, _, vt = np.linalg.svd(matrix @ rotation)  # against accumulated rounding
    return np.asarray(u @ vt, np.float64)


def yaw_pitch_roll(rotation: Array) -> tuple[float, float, float]:
    """Yaw, pitch and roll in degrees.

    Yaw is positive where the face looks to the picture's right, pitch where it looks up. Roll is about the direction of
    view of the face, positive counter-clockwise.
    """
    forward = rotation[:, 2]
    yaw, pitch = np.arctan2(forward[0], forward[2]), np.arcsin(np.clip(forward[1], -1, 1))
    level = np.array([np.cos(yaw), 0.0, -np.sin(yaw)])  # the face's x axis without roll
    roll = np.arctan2(rotation[:, 0] @ np.cross(forward, level), rotation[:, 0] @ level)
    return float(np.degrees(yaw)), float(np.degrees(pitch)), float(np.degrees(roll))


def _nearest_rotation(affine: Array) -> tuple[Array, float]:
    """The rotation and scale whose first two rows lie nearest to the 2 x 3 affine map."""
    u, sizes, vt = np.linalg.svd(affine, full_matrices=False)
    rows = u @ vt
    return np.vstack([rows, np.cross(rows[0], rows[1])]), max(float(sizes.mean()), 1e-12)
