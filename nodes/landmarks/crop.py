"""The upright square around a face, and the map from its pixels back to the picture's."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from graphface.nodes.types import FloatArray


@dataclass(frozen=True)
class Crop:
    """A square in the picture: `center` in pixels, `side` in pixels, `angle` of its x axis in radians (clockwise on
    the screen, as y points down)."""

    center: tuple[float, float]
    side: float
    angle: float

    def read(self, pixels: FloatArray, size: int) -> FloatArray:
        """The square as float32 (size, size, 3); black beyond the picture.

        A square much larger than `size` is first reduced by area means, since bilinear interpolation would alias.
        """
        scale = min(1.0, 2 * size / max(self.side, 1e-6))
        if scale < 1:
            pixels, offset = self._surroundings(pixels)
            height, width = pixels.shape[:2]
            target = (max(1, round(width * scale)), max(1, round(height * scale)))
            ratio = np.array([target[0] / width, target[1] / height])
            pixels = np.asarray(cv2.resize(pixels, target, interpolation=cv2.INTER_AREA), dtype=np.float32)
        else:
            offset, ratio = np.zeros(2), np.ones(2)
        matrix = self._matrix(size)
        matrix[:, 2] = (matrix[:, 2] - offset + 0.5) * ratio - 0.5
        matrix[:, :2] *= ratio[:, None]
        flags = cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP
        return np.asarray(cv2.warpAffine(pixels, matrix, (size, size), flags=flags), dtype=np.float32)

    def to_picture(self, points: FloatArray, size: int) -> FloatArray:
        """Points (n, 3) of the crop read at `size`, in its pixels with z away from the viewer, to picture pixels with z
        towards the viewer."""
        matrix = self._matrix(size)
        flat = points[:, :2] @ matrix[:, :2].T + matrix[:, 2]
        depth = -points[:, 2:] * (self.side / size)
        return np.concatenate([flat, depth], axis=1).astype(np.float32)

    def _matrix(self, size: int) -> NDArray[np.float64]:
        """(2, 3), from pixels of the resampled square to those of the picture."""
        scale = self.side / size
        cos, sin = np.cos(self.angle) * scale, np.sin(self.angle) * scale
        rotation = np.array([[cos, -sin], [sin, cos]])
        middle = (size - 1) / 2
        shift = np.array(self.center) - rotation @ (middle, middle)
        return np.concatenate([rotation, shift[:, None]], axis=1)

    def _surroundings(self, pixels: FloatArray) -> tuple[FloatArray, NDArray[np.float64]]:
        """The part of the picture around the square, and the pixel at its upper left corner."""
        reach = self.side / np.sqrt(2) + 2
        height, width = pixels.shape[:2]
        left, right = np.clip([self.center[0] - reach, self.center[0] + reach], 0, width)
        top, bottom = np.clip([self.center[1] - reach, self.center[1] + reach], 0, height)
        left, top = min(int(left), width - 1), min(int(top), height - 1)
        part = pixels[top : max(int(np.ceil(bottom)), top + 1), left : max(int(np.ceil(right)), left + 1)]
        return part, np.array([left, top], np.float64)


def crop_about(points: FloatArray, eyes: FloatArray, *, margin: float) -> Crop:
    """The square around points (n, 2), rotated so that the line through `eyes` (2, 2) is level.

    Args:
        margin: side of the square over the longer side of the points' bounding box in the rotated frame.
    """
    across = eyes[1] - eyes[0]
    angle = float(np.arctan2(across[1], across[0]))
    cos, sin = np.cos(angle), np.sin(angle)
    rotated = points @ np.array([[cos, -sin], [sin, cos]])
    low, high = rotated.min(axis=0), rotated.max(axis=0)
    center = np.array([[cos, -sin], [sin, cos]]) @ ((low + high) / 2)
    return Crop((float(center[0]), float(center[1])), float(max(high - low)) * margin, angle)
