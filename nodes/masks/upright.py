"""The head upright, at one size: a small grid in the face's own axes, which every photo is sampled onto.

What has learned on such grids needs to know neither roll nor size, and costs the same for every photo.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.head_shape import Pose, pose_of
from graphface.nodes.masks.prior import Layout, layout_of
from graphface.nodes.masks.window import Window
from graphface.nodes.types import FloatArray, Landmarks

HEIGHT, WIDTH = 96, 80
"""Of the grid, pixels."""


UNIT = 16.0
"""Pixels of the grid for one outer-eye-corner distance of the mean face: the grid reaches 2.5 to either side."""


ABOVE = 2.7
"""How far the grid reaches above the face's middle, in that distance; 3.3 below."""


@dataclass(frozen=True)
class Upright:
    """`matrix` (2, 3) takes photo pixels to grid pixels: a similarity."""

    matrix: NDArray[np.float64]

    @property
    def scale(self) -> float:
        """Grid pixels per photo pixel."""
        return float(np.hypot(*self.matrix[:, 0]))

    def sampled(self, values: NDArray[Any], fine: int = 1) -> FloatArray:
        """A map H x W x C on the grid, `fine` times as many pixels both ways; beyond the frame its border goes on.

        Where the photo has more pixels than the grid, means of areas are taken first.
        """
        import cv2

        matrix = _finer(self.matrix, fine)
        top, bottom, left, right = self._part(values.shape)
        cut = np.ascontiguousarray(values[top:bottom, left:right])
        share = min(1.0, self.scale * fine)
        size = (max(1, round(cut.shape[1] * share)), max(1, round(cut.shape[0] * share)))
        if size != cut.shape[1::-1]:
            cut = np.asarray(cv2.resize(cut, size, interpolation=cv2.INTER_AREA))
        steps = (right - left) / size[0], (bottom - top) / size[1]
        from_cut = np.array([[steps[0], 0, left + steps[0] / 2 - 0.5], [0, steps[1], top + steps[1] / 2 - 0.5]])
        whole = matrix @ np.vstack([from_cut, [0, 0, 1]])
        size_ = (WIDTH * fine, HEIGHT * fine)
        return np.asarray(
            cv2.warpAffine(cut, whole, size_, flags=cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE), np.float32
        )

    def seen(self, shape: tuple[int, ...], fine: int = 1) -> FloatArray:
        """1 where a pixel of the grid lies within a photo of `shape`, else 0."""
        x, y = self._photo_positions(fine)
        inside = (x > -0.5) & (x < shape[1] - 0.5) & (y > -0.5) & (y < shape[0] - 0.5)
        return inside.astype(np.float32)

    def laid_back(self, values: FloatArray, shape: tuple[int, ...]) -> FloatArray:
        """A map of the grid, HEIGHT x WIDTH (x C), on a photo of `shape`, linearly interpolated; 0 beyond the grid."""
        import cv2

        top, bottom, left, right = self._part(shape)
        to_grid = self.matrix.copy()
        to_grid[:, 2] += to_grid[:, :2] @ (left, top)
        flags = cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP
        full = np.zeros((*shape[:2], *values.shape[2:]), np.float32)
        full[top:bottom, left:right] = cv2.warpAffine(values, to_grid, (right - left, bottom - top), flags=flags)
        return full

    def layout(self, landmarks: Landmarks) -> Layout:
        """The geometry of the face on the grid."""
        return layout_of(self.placed(landmarks), Window(0, HEIGHT, 0, WIDTH, HEIGHT, WIDTH))

    def placed(self, landmarks: Landmarks, fine: int = 1) -> Landmarks:
        """The landmarks in pixels of the grid, their depth too."""
        matrix, points = _finer(self.matrix, fine), landmarks.points.copy()
        points[:, :2] = points[:, :2] @ matrix[:, :2].T + matrix[:, 2]
        points[:, 2] *= self.scale * fine
        return replace(landmarks, points=points)

    def _photo_positions(self, fine: int = 1) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        matrix = _finer(self.matrix, fine)
        inverse = np.linalg.inv(matrix[:, :2])
        v, u = np.mgrid[: HEIGHT * fine, : WIDTH * fine].astype(np.float64)
        u, v = u - matrix[0, 2], v - matrix[1, 2]
        return inverse[0, 0] * u + inverse[0, 1] * v, inverse[1, 0] * u + inverse[1, 1] * v

    def _part(self, shape: tuple[int, ...]) -> tuple[int, int, int, int]:
        """Top, bottom, left, right of the grid in the photo, with a margin; at least one pixel of the photo."""
        x, y = self._photo_positions()
        margin = 2 + 2 / max(self.scale, 1e-6)

        def cut(low: float, high: float, size: int) -> tuple[int, int]:
            first = int(np.clip(np.floor(low - margin), 0, size - 1))
            return first, int(np.clip(np.ceil(high + margin) + 1, first + 1, size))

        return *cut(y.min(), y.max(), shape[0]), *cut(x.min(), x.max(), shape[1])


def upright_of(landmarks: Landmarks) -> Upright:
    """The grid about a face: its roll is taken out, its turn stays."""
    pose = pose_of(landmarks)
    return Upright(_matrix(pose))


def _matrix(pose: Pose) -> NDArray[np.float64]:
    up = pose.rotation[:2, 1]
    length = float(np.hypot(*up))
    up_x, up_y = up / length if length > 1e-3 else np.array([0.0, 1.0])
    step = UNIT / max(pose.scale, 1e-3)
    turn = step * np.array([[up_y, up_x], [-up_x, up_y]])
    middle = np.array([(WIDTH - 1) / 2, ABOVE * UNIT - 0.5])
    return np.column_stack([turn, middle - turn @ pose.offset])


def _finer(matrix: NDArray[np.float64], fine: int) -> NDArray[np.float64]:
    """The same grid with `fine` times as many pixels; the centre of pixel (0, 0) moves."""
    finer = matrix * fine
    finer[:, 2] += (fine - 1) / 2
    return finer
