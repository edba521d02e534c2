"""Pose of a rigid shape from its projection, in closed form: where fitting starts."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Pose:
    """Model to camera frame: `scale` (pixels) times `rotation` (3, 3), plus `offset` (2,) in the picture, y up.

    `thinness` of the points seen: how much longer than wide they lie (1 for a disc, infinity for a line).
    """

    rotation: Array
    scale: float
    offset: Array
    thinness: float = 1.0


def closed_form(shape: Array, points: Array, *, rounds: int = 8, ridge: float = 1e-6) -> Pose:
    """The scaled-orthographic pose that takes `shape` (n, 3) to `points` (n, 2; y up), robust to some wild points.

    The best affine camera is a linear problem; the scaled rotation nearest to it is its polar factor. Points that lie
    far off are weighed down and the problem is solved again (Geman and McClure's weights, scale from the median).

    Args:
        rounds: of reweighting.
        ridge: keeps flat or coincident points solvable, relative to the shape's spread.
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


def turned(rotation: Array, turn: Array) -> Array:
    """`rotation` followed by a turn about the axis `turn` (3,), whose length is the angle in radians (Rodrigues)."""
    angle = float(np.linalg.norm(turn))
    if angle < 1e-12:
        return rotation
    x, y, z = turn / angle
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    matrix = np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross
    u, _, vt = np.linalg.svd(matrix @ rotation)  # rounding must not build up
    return np.asarray(u @ vt, np.float64)


def yaw_pitch_roll(rotation: Array) -> tuple[float, float, float]:
    """Degrees: yaw is positive where the face looks to the picture's right, pitch where it looks up, roll where the
    head leans counter-clockwise, about the direction that it looks in.
    """
    forward = rotation[:, 2]
    yaw, pitch = np.arctan2(forward[0], forward[2]), np.arcsin(np.clip(forward[1], -1, 1))
    level = np.array([np.cos(yaw), 0.0, -np.sin(yaw)])  # where the face's x axis points without roll
    roll = np.arctan2(rotation[:, 0] @ np.cross(forward, level), rotation[:, 0] @ level)
    return float(np.degrees(yaw)), float(np.degrees(pitch)), float(np.degrees(roll))


def _nearest_rotation(affine: Array) -> tuple[Array, float]:
    """The rotation and scale whose first two rows lie nearest to the 2 x 3 affine map."""
    u, sizes, vt = np.linalg.svd(affine, full_matrices=False)
    rows = u @ vt
    return np.vstack([rows, np.cross(rows[0], rows[1])]), max(float(sizes.mean()), 1e-12)
