"""Values of the reference fetched to the input's pixels, each interpolated once."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.types import Correspondence, FloatArray

_LARGEST_CONDITION = 1.5
"""Reference pixels per input pixel above which the reference is shrunk first, lest fine texture turn into noise."""


def fetched(values: FloatArray, correspondence: Correspondence) -> FloatArray:
    """`values` (of the reference's size, with or without channels) at every input pixel, by cubic interpolation.

    Points that the reference hides come from their mirror images, going over softly; places outside of the reference
    repeat its edge (their validity is 0). Off the mesh the values mean nothing.
    """
    import cv2

    rows, columns = _box(correspondence.inside > 0)
    places = correspondence.places[rows, columns]
    out = np.zeros((*correspondence.inside.shape, *values.shape[2:]), np.float32)
    if places.size == 0:
        return out
    shrink = _magnification(places, correspondence.inside[rows, columns])
    factor = None
    if shrink > _LARGEST_CONDITION:
        height, width = (max(1, round(n / shrink)) for n in values.shape[:2])
        factor = np.array([width / values.shape[1], height / values.shape[0]], np.float32)
        values = np.asarray(cv2.resize(values, (width, height), interpolation=cv2.INTER_AREA), np.float32)
    values = np.ascontiguousarray(values)

    def at(positions: FloatArray) -> FloatArray:
        if factor is not None:
            positions = (positions + np.float32(0.5)) * factor - np.float32(0.5)
        return np.asarray(
            cv2.remap(values, positions, None, cv2.INTER_CUBIC, borderMode=cv2.BORDER_REPLICATE),  # type: ignore[call-overload]
            np.float32,
        )

    window = at(places)
    if correspondence.mirrored is not None and correspondence.mirrored_valid is not None:
        other = correspondence.mirrored_valid[rows, columns]
        if other.any():
            part = _box(other > 0)
            # The mirror image as far as it is valid; where the point itself is not, nothing but it.
            rest = correspondence.valid[rows, columns][part] * (1 - other[part])
            share = other[part] / np.maximum(other[part] + rest, 1e-6)
            share = share.reshape(*share.shape, *[1] * (values.ndim - 2))
            window[part] += share * (at(correspondence.mirrored[rows, columns][part]) - window[part])
    out[rows, columns] = window
    return out


def _box(covered: NDArray[np.bool_]) -> tuple[slice, slice]:
    """The bounding box of what is covered."""
    rows, columns = np.flatnonzero(covered.any(axis=1)), np.flatnonzero(covered.any(axis=0))
    if rows.size == 0:
        return slice(0, 0), slice(0, 0)
    return slice(rows[0], rows[-1] + 1), slice(columns[0], columns[-1] + 1)


def _magnification(places: FloatArray, inside: FloatArray) -> float:
    """Median number of reference pixels that one step in the input crosses, over the face.

    Of a big picture every fourth pixel is asked: it is one number for the whole face.
    """
    sparse = (slice(None, None, 4 if min(inside.shape) > 64 else 1),) * 2
    both = (inside[1:, 1:][sparse] > 0) & (inside[:-1, :-1][sparse] > 0)
    if not both.any():
        return 1.0
    along = places[1:, 1:][sparse] - places[:-1, :-1][sparse]
    return float(np.median(np.hypot(along[..., 0], along[..., 1])[both])) / float(np.sqrt(2))
