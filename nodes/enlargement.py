"""Maps of a small picture at the size of a large one, a few rows at a time.

`Enlarged` is bilinear, for what is smooth. `linear_masks` gives masks that follow the edges of the large picture.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.color import channel_mean
from graphface.nodes.face_scale import FaceScale
from graphface.nodes.linear_functions import linear_functions
from graphface.nodes.types import FloatArray


class Enlarged:
    """Maps, each h x w, enlarged to (height, width) by bilinear interpolation as OpenCV does it.

    Only the width is enlarged at once, so each takes h / height of the memory of a large map.

    >>> small = np.float32([[0, 1], [2, 3]])
    >>> Enlarged([small], (4, 4)).rows(slice(1, 3))
    array([[[0.5 , 0.75, 1.25, 1.5 ],
            [1.5 , 1.75, 2.25, 2.5 ]]], dtype=float32)
    """

    def __init__(self, maps: Sequence[FloatArray], size: tuple[int, int]) -> None:
        import cv2

        (height, width), least = size, maps[0].shape[0]
        self._same = maps[0].shape == size
        wide = maps if self._same else [cv2.resize(map_, (width, least)) for map_ in maps]
        self._wide = np.asarray(np.stack(list(wide)), np.float32)
        place = np.clip((np.arange(height) + 0.5) * (least / max(height, 1)) - 0.5, 0, least - 1)
        self._above: NDArray[np.intp] = np.minimum(place.astype(np.intp), max(least - 2, 0))
        self._below = (place - self._above).astype(np.float32)[:, None]

    def rows(self, rows: slice) -> FloatArray:
        """Some rows of the large maps, number of maps x n x width; a view where both have one size."""
        if self._same:
            return self._wide[:, rows]
        above, below = self._above[rows], self._below[rows]
        part = np.empty((len(self._wide), len(above), self._wide.shape[2]), np.float32)
        # Rows between the same two rows of the small maps are one product.
        starts = [0, *(np.flatnonzero(np.diff(above)) + 1), len(above)]
        for start, stop in pairwise(starts):
            first = self._wide[:, above[start], None]
            step = self._wide[:, min(above[start] + 1, self._wide.shape[1] - 1), None] - first
            band = np.multiply(below[start:stop], step, out=part[:, start:stop])
            band += first
        return part


def linear_masks(
    masks: Mapping[str, FloatArray], small: FloatArray, copy: FaceScale, *, radius: float, ridge: float
) -> dict[str, list[FloatArray]]:
    """Masks of a small picture as linear functions of its color, which may be applied to a larger one.

    Args:
        masks: h x w each. small: the picture that they belong to, h x w x 3.
        copy: of the small picture, on which the functions are found (`linear_functions`).
        radius: half of the windows' side, in inter-ocular distances. ridge: see `linear_functions`.

    Returns:
        For each mask a red, a green, a blue, h x w each, and b: a . color + b is the mask itself on the small picture,
        and follows the edges of a larger one.
    """
    side = 2 * max(1, round(radius * copy.interocular)) + 1
    stacked = copy.down(np.stack(list(masks.values()), axis=2)).reshape(*copy.size, len(masks))
    coefficients = linear_functions(copy.down(small).reshape(*copy.size, 3), stacked, side, ridge)
    found = {}
    for number, (name, mask) in enumerate(masks.items()):
        slopes = copy.up(np.ascontiguousarray(coefficients[..., 4 * number : 4 * number + 3]))
        found[name] = [*(slopes[..., c] for c in range(3)), mask - 3 * channel_mean(slopes * small)]
    return found
