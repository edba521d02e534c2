"""The part of a photo that may hold head and hair, at the resolution that classifiers work on.

Cost follows the size of the face and not of the photo: a small face in a large photo costs as much as a portrait.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.face_scale import face_scale
from graphface.nodes.head_shape import pose_of
from graphface.nodes.types import FloatArray, Landmarks

REACH = (3.0, 2.8, 3.2)
"""Extent of the window to each side, above and below the middle of the face, in inter-ocular distances."""


MAX_SIDE = 1024
"""Longest side of the window at working size, pixels."""


@dataclass(frozen=True)
class Window:
    """Pixels top <= y < bottom, left <= x < right of a photo, resampled to height x width."""

    top: int
    bottom: int
    left: int
    right: int
    height: int
    width: int

    @property
    def part(self) -> tuple[slice, slice]:
        """The window as an index into the photo."""
        return slice(self.top, self.bottom), slice(self.left, self.right)

    @property
    def scale(self) -> float:
        """Working pixels per photo pixel."""
        return self.width / (self.right - self.left)

    def downsampled(self, values: FloatArray) -> FloatArray:
        """The window of a map, H x W (x C), as area means at working size."""
        import cv2

        cut = np.ascontiguousarray(values[self.part], np.float32)
        size = (self.width, self.height)
        return cut if cut.shape[1::-1] == size else np.asarray(cv2.resize(cut, size, interpolation=cv2.INTER_AREA))

    def upsampled(self, values: FloatArray, shape: tuple[int, ...], outside: float) -> FloatArray:
        """A map of working size in a photo of `shape`, linearly interpolated; `outside` beyond the window."""
        import cv2

        size = (self.right - self.left, self.bottom - self.top)
        full = np.full(shape[:2], outside, np.float32)
        full[self.part] = cv2.resize(values, size, interpolation=cv2.INTER_LINEAR)
        return full

    def positions(self) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
        """x and y in the photo of each working pixel's center, as a row and a column that broadcast."""
        step_x, step_y = (self.right - self.left) / self.width, (self.bottom - self.top) / self.height
        x = self.left - 0.5 + (np.arange(self.width, dtype=np.float32)[None] + 0.5) * step_x
        y = self.top - 0.5 + (np.arange(self.height, dtype=np.float32)[:, None] + 0.5) * step_y
        return x.astype(np.float32), y.astype(np.float32)

    def to_window(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Photo coordinates (n, 2) to working coordinates.

        >>> Window(10, 30, 20, 40, 10, 10).to_window(np.array([[19.5, 9.5]])).tolist()
        [[-0.5, -0.5]]
        """
        step = ((self.right - self.left) / self.width, (self.bottom - self.top) / self.height)
        moved: NDArray[np.float64] = (points - (self.left - 0.5, self.top - 0.5)) / step - 0.5
        return moved


def window_about(landmarks: Landmarks, shape: tuple[int, ...], resolution: int) -> Window:
    """The window about a face, in which the inter-ocular distance has at most `resolution` pixels.

    A face outside the frame gives the whole picture.
    """
    height, width = shape[:2]
    unit = max(landmarks.interocular, 1e-3)
    pose = pose_of(landmarks)
    side, above, below = (reach * max(unit, pose.scale) for reach in REACH)
    x, y = pose.offset
    up = pose.rotation[:2, 1]
    if up[1] < 0.5:  # lying or upside down: the hair may be on any side
        side = above = below = max(side, above, below)
    left, right = _clipped(x - side, x + side, width)
    top, bottom = _clipped(y - above, y + below, height)
    height, width = face_scale(landmarks, (bottom - top, right - left), resolution, most=MAX_SIDE).size
    return Window(top, bottom, left, right, height, width)


def _clipped(low: float, high: float, size: int) -> tuple[int, int]:
    """The range of pixels within the frame; the whole frame where the range lies outside of it."""
    if not (np.isfinite([low, high]).all() and high > 1 and low < size - 1):
        return 0, size
    return max(0, int(np.floor(low))), min(size, int(np.ceil(high)))
