"""Maps of a small copy at the size of the picture, a few rows at a time.

`Enlarged` is bilinear, for what is smooth. `Carried` follows the edges of the picture, for masks.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.color import channel_mean
from graphface.nodes.face_scale import FaceScale
from graphface.nodes.linear_functions import linear_functions
from graphface.nodes.types import FloatArray


class Enlarged:
    """A map of h x w (x c) enlarged to (height, width), by bilinear interpolation as OpenCV does it.

    Only the width is enlarged at once, so it takes h / height of the memory of the large map.

    >>> small = np.float32([[0, 1], [2, 3]])
    >>> Enlarged(small, (4, 4)).rows(slice(1, 3))
    array([[0.5 , 0.75, 1.25, 1.5 ],
           [1.5 , 1.75, 2.25, 2.5 ]], dtype=float32)
    """

    def __init__(self, small: FloatArray, size: tuple[int, int]) -> None:
        import cv2

        (height, width), least = size, small.shape[0]
        self._same = small.shape[:2] == size
        self._wide = small if self._same else np.asarray(cv2.resize(small, (width, least)), np.float32)
        place = np.clip((np.arange(height) + 0.5) * (least / max(height, 1)) - 0.5, 0, least - 1)
        self._above: NDArray[np.intp] = np.minimum(place.astype(np.intp), max(least - 2, 0))
        below = (place - self._above).astype(np.float32)
        self._below = below.reshape(-1, *[1] * (small.ndim - 1))

    def rows(self, rows: slice) -> FloatArray:
        """Some rows of the large map, n x width (x c); a view where both have one size."""
        if self._same:
            return self._wide[rows]
        above = self._above[rows]
        part = self._wide[np.minimum(above + 1, len(self._wide) - 1)]
        first = self._wide[above]
        part -= first
        part *= self._below[rows]
        part += first
        return part


@dataclass(frozen=True)
class Carried:
    """A mask of a small picture, to be carried to a larger one along its edges.

    In every small window it is a linear function of color (`linear_functions`).

    Attributes:
        slopes: h x w x 3.
        rest: h x w, the mask minus slopes . color, so that on the small picture it is the mask itself.
    """

    slopes: FloatArray
    rest: FloatArray

    def at(self, size: tuple[int, int]) -> EnlargedMask:
        """For a picture of (height, width)."""
        return EnlargedMask(Enlarged(self.slopes, size), Enlarged(self.rest, size))


@dataclass(frozen=True)
class EnlargedMask:
    """A `Carried` mask for a picture of a given size."""

    slopes: Enlarged
    rest: Enlarged

    def rows(self, rows: slice, pixels: FloatArray) -> FloatArray:
        """Some rows of the mask, n x W in [0, 1]; `pixels` are the picture's there, n x W x 3."""
        value = channel_mean(self.slopes.rows(rows) * pixels)
        value *= 3
        value += self.rest.rows(rows)
        return np.clip(value, 0, 1, out=value)


def carried(
    masks: dict[str, FloatArray], small: FloatArray, copy: FaceScale, *, radius: float, ridge: float
) -> dict[str, Carried]:
    """Masks of a small picture that are carried to a picture of another size.

    Args:
        masks: h x w each. small: the picture that they belong to, h x w x 3.
        copy: of the small picture, on which the linear functions are found.
        radius: half of the windows' side, in inter-ocular distances. ridge: see `linear_functions`.
    """
    side = 2 * max(1, round(radius * copy.interocular)) + 1
    stacked = copy.down(np.stack(list(masks.values()), axis=2)).reshape(*copy.size, len(masks))
    coefficients = linear_functions(copy.down(small).reshape(*copy.size, 3), stacked, side, ridge)
    found = {}
    for number, (name, mask) in enumerate(masks.items()):
        slopes = copy.up(np.ascontiguousarray(coefficients[..., 4 * number : 4 * number + 3]))
        found[name] = Carried(slopes, mask - 3 * channel_mean(slopes * small))
    return found
