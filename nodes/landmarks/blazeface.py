"""BlazeFace: faces and six points on each, from one run of the network.

Bazarevsky et al., BlazeFace: Sub-millisecond Neural Face Detection on Mobile GPUs, CVPR Workshops 2019. The network
gives a logit, a box and six points for each anchor of a fixed grid, relative to the anchor's center. Overlapping
detections are averaged, weighted by their scores (the paper's tie resolution), rather than suppressed.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cache
from typing import Any, Literal

import cv2
import numpy as np
from numpy.typing import NDArray

from graphface.assets.asset import Asset
from graphface.nodes.landmarks.network import run_network, sigmoid
from graphface.nodes.landmarks.weights import BLAZEFACE, BLAZEFACE_FULL_RANGE
from graphface.nodes.types import FloatArray

Floats = NDArray[np.floating[Any]]


Range = Literal["near", "far"]


MERGE_OVERLAP = 0.3
"""Detections whose boxes overlap more than this (intersection over union) are one face."""


@dataclass(frozen=True, eq=False)
class Face:
    """A detected face, in pixels of the picture it was searched in.

    `box` float32 (4,): left, top, right, bottom. `points` float32 (6, 2): right eye, left eye (the person's, so right
    is on the left of the picture), nose tip, mouth, right ear, left ear. `score` 0..1.
    """

    box: FloatArray
    points: FloatArray
    score: float

    @property
    def size(self) -> float:
        """The longer side of the box."""
        return float(max(self.box[2] - self.box[0], self.box[3] - self.box[1]))

    @property
    def center(self) -> FloatArray:
        """The middle of the box, (2,)."""
        return np.asarray((self.box[:2] + self.box[2:]) / 2, np.float32)

    def transformed(self, matrix: FloatArray) -> Face:
        """The face after a similarity (2, 3) of the plane; the box is the bounding box of the transformed corners."""
        left, top, right, bottom = self.box
        corners = np.array([[left, top], [right, top], [right, bottom], [left, bottom]], np.float32)
        corners = corners @ matrix[:, :2].T + matrix[:, 2]
        box = np.concatenate([corners.min(axis=0), corners.max(axis=0)]).astype(np.float32)
        points = (self.points @ matrix[:, :2].T + matrix[:, 2]).astype(np.float32)
        return replace(self, box=box, points=points)


@dataclass(frozen=True)
class _Model:
    asset: Asset
    side: int
    grids: tuple[tuple[int, int], ...]
    """Cells along a side, and anchors in each cell."""
    scores: str
    boxes: str


_MODELS: dict[Range, _Model] = {
    "near": _Model(BLAZEFACE, 256, ((16, 2), (8, 6)), "classificators", "regressors"),
    "far": _Model(BLAZEFACE_FULL_RANGE, 192, ((48, 1),), "reshaped_classifier_face_4", "reshaped_regressor_face_4"),
}


def detect(pixels: FloatArray, *, model: Range = "near", min_score: float = 0.5) -> list[Face]:
    """All faces in `pixels` (float32 H x W x 3, sRGB, 0..1), the largest first.

    The picture is resized to fit the network's square, and padded with black.

    Args:
        model: "near" (256 x 256, faces down to about a twelfth of the picture) or "far" (192 x 192, smaller faces).
        min_score: least confidence of a detection, 0..1.
    """
    network = _MODELS[model]
    square, matrix = _letterbox(pixels, network.side)
    outputs = run_network(network.asset, square * 2 - 1)
    scores = sigmoid(outputs[network.scores].reshape(-1))
    chosen = np.flatnonzero(scores >= min_score)
    raw = outputs[network.boxes].reshape(-1, 8, 2)[chosen] / network.side
    anchors = _anchors(network.grids)[chosen]
    centers = (raw[:, 0] + anchors) * network.side
    half = np.maximum(raw[:, 1], 0) * network.side / 2
    points = (raw[:, 2:] + anchors[:, None]) * network.side
    boxes = np.concatenate([centers - half, centers + half], axis=1)
    faces = [face.transformed(matrix) for face in _merge(boxes, points, scores[chosen])]
    return sorted((f for f in faces if f.size > 0), key=lambda f: -f.size)


def _letterbox(pixels: FloatArray, side: int) -> tuple[FloatArray, FloatArray]:
    """The picture centered in a square, and the (2, 3) matrix from the square's continuous coordinates (0..side from
    edge to edge) to the picture's pixels."""
    height, width = pixels.shape[:2]
    scale = side / max(height, width)
    size = (max(1, round(width * scale)), max(1, round(height * scale)))
    small = cv2.resize(pixels, size, interpolation=cv2.INTER_AREA if scale < 1 else cv2.INTER_LINEAR)
    left, top = (side - size[0]) // 2, (side - size[1]) // 2
    square = np.zeros((side, side, 3), np.float32)
    square[top : top + size[1], left : left + size[0]] = small
    step_x, step_y = width / size[0], height / size[1]
    matrix = np.array([[step_x, 0, -left * step_x - 0.5], [0, step_y, -top * step_y - 0.5]], np.float32)
    return square, matrix


@cache
def _anchors(grids: tuple[tuple[int, int], ...]) -> FloatArray:
    """Centers of the cells in 0..1, (n, 2), row by row, each repeated for every anchor of its cell."""
    levels = []
    for cells, repeats in grids:
        y, x = np.mgrid[:cells, :cells]
        centers = (np.stack([x, y], axis=-1).reshape(-1, 2) + 0.5) / cells
        levels.append(np.repeat(centers, repeats, axis=0))
    return np.concatenate(levels).astype(np.float32)


def _merge(boxes: Floats, points: Floats, scores: Floats) -> list[Face]:
    """Groups of overlapping detections, best first, each replaced by its mean, weighted by the scores."""
    remaining = list(np.argsort(-scores, kind="stable"))
    faces = []
    while remaining:
        best = remaining[0]
        overlap = _overlap(boxes[best], boxes[remaining])
        group = [i for i, o in zip(remaining, overlap, strict=True) if o > MERGE_OVERLAP or i == best]
        weights = scores[group] / max(float(scores[group].sum()), 1e-9)
        box = np.tensordot(weights, boxes[group], axes=1)
        mean_points = np.tensordot(weights, points[group], axes=1)
        faces.append(Face(box.astype(np.float32), mean_points.astype(np.float32), float(scores[best])))
        remaining = [i for i in remaining if i not in set(group)]
    return faces


def _overlap(box: Floats, boxes: Floats) -> FloatArray:
    """Intersection over union of one box (4,) with each of (n, 4)."""
    low, high = np.maximum(box[:2], boxes[:, :2]), np.minimum(box[2:], boxes[:, 2:])
    common = np.prod(np.maximum(high - low, 0), axis=1)
    areas = np.prod(boxes[:, 2:] - boxes[:, :2], axis=1)
    union = np.prod(box[2:] - box[:2]) + areas - common
    return np.asarray(common / np.maximum(union, 1e-9), dtype=np.float32)
