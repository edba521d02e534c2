"""How near one geometry is to another: normals, directions, masks, landmarks."""

from __future__ import annotations

import numpy as np

from graphface.nodes.types import FloatArray, Landmarks, Mask, Normals

_LEAST_LENGTH = 1e-12


def mean_angle(normals: Normals, truth: Normals, mask: Mask | None = None) -> float:
    """Mean angle between two normal maps in degrees, over the pixels where both have a surface.

    Raises:
        ValueError: there is no such pixel.
    """
    both = np.any(normals != 0, axis=2) & np.any(truth != 0, axis=2)
    weights = both if mask is None else both * mask
    if not weights.any():
        raise ValueError("the two normal maps have no pixel in common")
    a, b = normals.astype(np.float64), truth.astype(np.float64)
    lengths = np.linalg.norm(a, axis=2) * np.linalg.norm(b, axis=2)
    cosine = np.einsum("hwc,hwc->hw", a, b) / np.maximum(lengths, _LEAST_LENGTH)
    return float(np.average(np.degrees(np.arccos(np.clip(cosine, -1, 1))), weights=weights))


def direction_angle(one: FloatArray, other: FloatArray) -> float:
    """Angle between two directions in degrees; 90 where one of them is zero, which points nowhere."""
    lengths = float(np.linalg.norm(one)) * float(np.linalg.norm(other))
    cosine = float(np.dot(one, other)) / max(lengths, _LEAST_LENGTH)
    return float(np.degrees(np.arccos(np.clip(cosine, -1, 1))))


def iou(one: Mask, other: Mask) -> float:
    """Intersection over union of two soft masks: sum of minima over sum of maxima; 1 where both are empty."""
    union = float(np.maximum(one, other).sum(dtype=np.float64))
    return float(np.minimum(one, other).sum(dtype=np.float64)) / union if union > _LEAST_LENGTH else 1.0


def landmark_error(result: Landmarks, truth: Landmarks) -> float:
    """Mean distance of the points in the picture over the true inter-ocular distance.

    Raises:
        ValueError: the two name different points.
    """
    if result.scheme != truth.scheme or result.points.shape != truth.points.shape:
        raise ValueError(f"landmarks of scheme {result.scheme} cannot be compared with {truth.scheme}")
    distance = np.linalg.norm(result.points[:, :2] - truth.points[:, :2], axis=1)
    return float(distance.mean()) / max(truth.interocular, 1e-3)
