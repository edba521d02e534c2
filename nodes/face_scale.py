"""A small copy of a picture, measured by the face: so many pixels between the eyes.

What is smooth is computed on such a copy and enlarged again. It costs the same in a large photo as in a small one, and
a setting in inter-ocular distances means the same in both. A face that is smaller already keeps its size.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from graphface.nodes.types import FloatArray, Landmarks

_LEAST_INTEROCULAR = 1e-3
"""Pixels; keeps landmarks that all fall together from a division by zero."""


@dataclass(frozen=True)
class FaceScale:
    """How a picture of `shape` is reduced; both sizes are (height, width) in pixels.

    `scale`: pixels of the copy per pixel of the picture, at most 1; `size` is `shape` times that, rounded.
    `interocular`: distance between the outer eye corners in pixels of the copy, above 0.
    """

    shape: tuple[int, int]
    size: tuple[int, int]
    scale: float
    interocular: float

    def down(self, values: FloatArray) -> FloatArray:
        """The copy of a map: float32 `shape` (x channels) to float32 `size` (x channels), by the mean over areas."""
        import cv2

        return np.asarray(cv2.resize(values, self.size[::-1], interpolation=cv2.INTER_AREA), np.float32)

    def up(self, values: FloatArray) -> FloatArray:
        """A map of the copy's size enlarged to `shape`, by bilinear interpolation: float32, channels as they are."""
        import cv2

        return np.asarray(cv2.resize(values, self.shape[::-1], interpolation=cv2.INTER_LINEAR), np.float32)


def face_scale(
    landmarks: Landmarks, shape: tuple[int, ...], resolution: float, *, least: int = 1, most: int | None = None
) -> FaceScale:
    """The copy in which the eyes are at most `resolution` pixels apart.

    Args:
        landmarks: of the face, in pixels of the picture. shape: the picture's (height, width); more axes are ignored.
        least, most: bounds of the copy's sides in pixels.

    >>> import numpy as np
    >>> points = np.zeros((68, 3), np.float32)
    >>> points[45, 0] = 200  # the outer corner of the left eye; that of the right eye lies at 0
    >>> copy = face_scale(Landmarks(points, "ibug68"), (600, 400, 3), resolution=50)
    >>> copy.size, copy.scale, copy.interocular
    ((150, 100), 0.25, 50.0)
    >>> copy.up(copy.down(np.ones((600, 400), np.float32))).shape
    (600, 400)
    """
    height, width = shape[:2]
    interocular = max(_LEAST_INTEROCULAR, landmarks.interocular)  # in this order NaN gives way
    scale = min(1.0, resolution / interocular)
    if most is not None:
        scale = min(scale, most / max(height, width))
    size = max(least, round(height * scale)), max(least, round(width * scale))
    return FaceScale((height, width), size, scale, interocular * scale)
