"""The upright grid: a small picture in the face's own axes, onto which every photo is warped.

A network on this grid need not learn roll or size, and costs the same for every photo.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.head_shape import pose_of
from graphface.nodes.masks.layout import Layout, layout_of
from graphface.nodes.masks.window import Window
from graphface.nodes.types import FloatArray, Landmarks

HEIGHT, WIDTH = 96, 80
"""Size of the grid, pixels."""


UNIT = 16.0
"""Grid pixels per outer-eye-corner distance of the mean face: the grid reaches 2.5 such units to either side."""


UNITS_ABOVE = 2.7
"""How far the grid reaches above the middle of the face, in units; 3.3 below."""


@dataclass(frozen=True)
class UprightGrid:
    """`matrix` (2, 3) maps photo pixels to grid pixels: a similarity.

    Methods with `supersampling` n work on a grid with n times as many pixels in each direction.
    """

    matrix: NDArray[np.float64]

    @property
    def scale(self) -> float:
        """Grid pixels per photo pixel."""
        return float(np.hypot(*self.matrix[:, 0]))

    def sampled(self, values: NDArray[Any], supersampling: int = 1) -> FloatArray:
        """A map H x W x C of the photo, warped onto the grid. Beyond the frame its border pixels are repeated.

        Where the photo is finer than the grid it is first reduced by area means, since linear interpolation would
        alias.
        """
        import cv2

        matrix = _supersampled(self.matrix, supersampling)
        top, bottom, left, right = self._bounding_box(values.shape)
        cut = np.ascontiguousarray(values[top:bottom, left:right])
        scale = min(1.0, self.scale * supersampling)
        size = (max(1, round(cut.shape[1] * scale)), max(1, round(cut.shape[0] * scale)))
        if size != cut.shape[1::-1]:
            cut = np.asarray(cv2.resize(cut, size, interpolation=cv2.INTER_AREA))
        step_x, step_y = (right - left) / size[0], (bottom - top) / size[1]
        cut_to_photo = np.array([[step_x, 0, left + step_x / 2 - 0.5], [0, step_y, top + step_y / 2 - 0.5]])
        cut_to_grid = matrix @ np.vstack([cut_to_photo, [0, 0, 1]])
        grid_size = (WIDTH * supersampling, HEIGHT * supersampling)
        warped = cv2.warpAffine(cut, cut_to_grid, grid_size, flags=cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)
        return np.asarray(warped, np.float32)

    def inside(self, shape: tuple[int, ...], supersampling: int = 1) -> FloatArray:
        """1 where a pixel of the grid lies within a photo of `shape`, else 0."""
        x, y = self._photo_positions(supersampling)
        inside = (x > -0.5) & (x < shape[1] - 0.5) & (y > -0.5) & (y < shape[0] - 0.5)
        return inside.astype(np.float32)

    def unwarped(self, values: FloatArray, shape: tuple[int, ...]) -> FloatArray:
        """A map of the grid, HEIGHT x WIDTH (x C), on a photo of `shape`, linearly interpolated; 0 beyond the grid."""
        import cv2

        top, bottom, left, right = self._bounding_box(shape)
        to_grid = self.matrix.copy()
        to_grid[:, 2] += to_grid[:, :2] @ (left, top)
        flags = cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP
        full = np.zeros((*shape[:2], *values.shape[2:]), np.float32)
        full[top:bottom, left:right] = cv2.warpAffine(values, to_grid, (right - left, bottom - top), flags=flags)
        return full

    def layout(self, landmarks: Landmarks) -> Layout:
        """The geometry of the face on the grid."""
        return layout_of(self.to_grid(landmarks), Window(0, HEIGHT, 0, WIDTH, HEIGHT, WIDTH))

    def to_grid(self, landmarks: Landmarks, supersampling: int = 1) -> Landmarks:
        """The landmarks in pixels of the grid, their depth too."""
        matrix, points = _supersampled(self.matrix, supersampling), landmarks.points.copy()
        points[:, :2] = points[:, :2] @ matrix[:, :2].T + matrix[:, 2]
        points[:, 2] *= self.scale * supersampling
        return replace(landmarks, points=points)

    def _photo_positions(self, supersampling: int = 1) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """x and y in the photo of each grid pixel, HEIGHT x WIDTH each."""
        matrix = _supersampled(self.matrix, supersampling)
        inverse = np.linalg.inv(matrix[:, :2])
        v, u = np.mgrid[: HEIGHT * supersampling, : WIDTH * supersampling].astype(np.float64)
        u, v = u - matrix[0, 2], v - matrix[1, 2]
        return inverse[0, 0] * u + inverse[0, 1] * v, inverse[1, 0] * u + inverse[1, 1] * v

    def _bounding_box(self, shape: tuple[int, ...]) -> tuple[int, int, int, int]:
        """Top, bottom, left, right of the grid in a photo, with a margin; at least one pixel of the photo."""
        x, y = self._photo_positions()
        margin = 2 + 2 / max(self.scale, 1e-6)

        def clipped(low: float, high: float, size: int) -> tuple[int, int]:
            first = int(np.clip(np.floor(low - margin), 0, size - 1))
            return first, int(np.clip(np.ceil(high + margin) + 1, first + 1, size))

        return *clipped(y.min(), y.max(), shape[0]), *clipped(x.min(), x.max(), shape[1])


def upright_grid(landmarks: Landmarks) -> UprightGrid:
    """The grid about a face. It is rotated by the face's roll; a face in profile stays in profile."""
    pose = pose_of(landmarks)
    up_x, up_y = pose.up
    scale = UNIT / max(pose.scale, 1e-3)
    linear = scale * np.array([[up_y, up_x], [-up_x, up_y]])
    middle = np.array([(WIDTH - 1) / 2, UNITS_ABOVE * UNIT - 0.5])
    return UprightGrid(np.column_stack([linear, middle - linear @ pose.offset]))


def _supersampled(matrix: NDArray[np.float64], factor: int) -> NDArray[np.float64]:
    """The same grid with `factor` times as many pixels in each direction; the center of pixel (0, 0) moves."""
    finer = matrix * factor
    finer[:, 2] += (factor - 1) / 2
    return finer
