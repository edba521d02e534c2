"""A small upright crop about a face, the same for every size of photo: what the normal network sees."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphface import warn
from graphface.nodes.landmark_schemes import ibug68
from graphface.nodes.types import FloatArray, Landmarks

SIZE = 128
"""Pixels along a side."""


INTEROCULAR = 56.0
"""Pixels between the outer eye corners of a frontal face; the crop reaches 1.1 such distances to each side."""


_MOUTH_DISTANCE = 1.32
"""Eye distance over the distance from the eyes to the mouth, of an average face: yaw shortens the former only."""

_BORDER, _SOFTNESS = 3, 5
"""Pixels at the crop's edges that are left as they are, and over which the change begins."""


@dataclass(frozen=True)
class FaceCrop:
    """`matrix` (2, 3) takes photo pixels to the crop's; it turns by `angle`, radians, and scales by `scale`."""

    matrix: NDArray[np.float64]
    angle: float
    scale: float

    def sampled(self, values: NDArray[Any]) -> FloatArray:
        """A map H x W (x C) of the photo on the crop, SIZE x SIZE (x C); beyond the frame its edges are repeated.

        Where the photo is finer it is first reduced by area means, since linear interpolation would alias.
        """
        top, bottom, left, right = window = self.window(values.shape)
        return self.sampled_window(values[top:bottom, left:right], window)

    def sampled_window(self, values: NDArray[Any], window: tuple[int, int, int, int]) -> FloatArray:
        """The same for the part of a map that `window` names."""
        import cv2

        top, bottom, left, right = window
        cut = np.ascontiguousarray(values, np.float32)
        scale = min(1.0, 1.4 * self.scale)
        size = (max(1, round(cut.shape[1] * scale)), max(1, round(cut.shape[0] * scale)))
        if size != cut.shape[1::-1]:
            cut = np.asarray(cv2.resize(cut, size, interpolation=cv2.INTER_AREA))
        step_x, step_y = (right - left) / size[0], (bottom - top) / size[1]
        to_photo = np.array(
            [[step_x, 0, left + step_x / 2 - 0.5], [0, step_y, top + step_y / 2 - 0.5], [0, 0, 1]], np.float64
        )
        warped = cv2.warpAffine(
            cut, self.matrix @ to_photo, (SIZE, SIZE), flags=cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE
        )
        return np.asarray(warped, np.float32)

    def unwarped(self, values: FloatArray, window: tuple[int, int, int, int]) -> FloatArray:
        """A map of the crop, SIZE x SIZE (x C), on a window of the photo, fading out at the crop's edges."""
        import cv2

        top, bottom, left, right = window
        fade = np.zeros((SIZE, SIZE), np.float32)
        fade[_BORDER:-_BORDER, _BORDER:-_BORDER] = 1
        faded = values * cv2.blur(fade, (_SOFTNESS, _SOFTNESS)).reshape(SIZE, SIZE, *[1] * (values.ndim - 2))
        matrix = self.matrix.copy()
        matrix[:, 2] += matrix[:, :2] @ (left, top)
        flags = cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP
        return np.asarray(cv2.warpAffine(faded, matrix, (right - left, bottom - top), flags=flags), np.float32)

    def rim(self, width: float) -> FloatArray:
        """0 at the crop's edges, 1 from `width` inter-ocular distances within, SIZE x SIZE."""
        ramp = np.minimum(np.arange(SIZE), np.arange(SIZE)[::-1]) / max(width * INTEROCULAR, 1.0)
        ramp = np.clip(ramp, 0, 1).astype(np.float32)
        return np.minimum(ramp, ramp[:, None])

    def turned(self, vectors: FloatArray, back: bool = False) -> FloatArray:
        """Vectors (..., 3), x right and y up, from the photo's axes to the crop's, or back."""
        cosine, sine = np.cos(self.angle), np.sin(self.angle) * (-1 if back else 1)
        x, y = vectors[..., 0], vectors[..., 1]
        return np.stack([cosine * x - sine * y, sine * x + cosine * y, vectors[..., 2]], axis=-1).astype(np.float32)

    def window(self, shape: tuple[int, ...]) -> tuple[int, int, int, int]:
        """Top, bottom, left and right of the crop in a photo, with a margin; at least one pixel."""
        linear = np.linalg.inv(self.matrix[:, :2])
        corners = np.array([(x, y) for x in (0, SIZE - 1) for y in (0, SIZE - 1)]) - self.matrix[:, 2]
        photo = corners @ linear.T
        margin = 2 + 2 / self.scale

        def clipped(low: float, high: float, size: int) -> tuple[int, int]:
            first = int(np.clip(np.floor(low - margin), 0, size - 1))
            return first, int(np.clip(np.ceil(high + margin) + 1, first + 1, size))

        (left, top), (right, bottom) = photo.min(axis=0), photo.max(axis=0)
        return *clipped(top, bottom, shape[0]), *clipped(left, right, shape[1])


def face_crop(landmarks: Landmarks) -> FaceCrop:
    """The crop about a face: upright by its eyes and its mouth, its size by the larger of their distances.

    Landmarks that are no numbers, or that fall together, give a crop at their mean as if the face were a pixel wide,
    with a warning.
    """
    points = np.asarray(ibug68(landmarks).points[:, :2], np.float64)
    if not np.isfinite(points).all():
        warn("surface.refined: landmarks are not finite; the normals stay as they are")
        points = np.zeros_like(points)
    eyes, mouth = (points[36] + points[45]) / 2, points[[48, 54]].mean(axis=0)
    across, down = points[45] - points[36], mouth - eyes
    size = max(float(np.hypot(*across)), _MOUTH_DISTANCE * float(np.hypot(*down)), 1.0)
    # Both uprights as complex numbers of the length that they were measured over; their sum is the mean direction.
    upright = complex(*across) + complex(*down) / 1j
    angle = -float(np.angle(upright)) if abs(upright) > 1e-6 else 0.0
    scale = INTEROCULAR / size
    cosine, sine = np.cos(angle) * scale, np.sin(angle) * scale
    linear = np.array([[cosine, -sine], [sine, cosine]])
    middle = np.full(2, SIZE / 2 - 0.5) - linear @ (eyes + 0.35 * down)
    return FaceCrop(np.column_stack([linear, middle]), -angle, scale)
