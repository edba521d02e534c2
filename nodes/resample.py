"""Values of the reference resampled at the input's pixels, each interpolated once."""

from __future__ import annotations

import numpy as np

from graphface.nodes.bounding_box import bounding_box
from graphface.nodes.types import Correspondence, FloatArray

_LARGEST_STEP = 1.5
"""Reference pixels per input pixel above which the reference is reduced first, so that fine texture does not alias."""


def resampled(values: FloatArray, correspondence: Correspondence) -> FloatArray:
    """Values of the reference at every input pixel, by bicubic interpolation (OpenCV's, a = -0.75).

    Points that the reference does not show get the value at their mirror image, with a soft transition. Positions
    outside of the reference get the value at its border (their validity is 0). Off the mesh the values mean nothing.

    Args:
        values: float32 of the reference's size, H' x W' or H' x W' x c.
        correspondence: reference position of each input pixel, H x W.

    Returns:
        float32 H x W or H x W x c; may overshoot the range of `values` at edges, as bicubic interpolation does.

    >>> y, x = np.mgrid[:8, :8].astype(np.float32)
    >>> everywhere = np.ones((8, 8), np.float32)
    >>> one_to_the_right = Correspondence(np.dstack([x + 1, y]), everywhere, everywhere, (8, 8))
    >>> resampled(x, one_to_the_right)[0]  # the last position is outside and repeats the border
    array([1., 2., 3., 4., 5., 6., 7., 7.], dtype=float32)
    """
    import cv2

    out = np.zeros((*correspondence.inside.shape, *values.shape[2:]), np.float32)
    box = bounding_box(correspondence.inside > 0)
    if box is None:
        return out
    places = correspondence.places[box]
    step = _median_step(places, correspondence.inside[box])
    factor = None
    if step > _LARGEST_STEP:
        height, width = (max(1, round(n / step)) for n in values.shape[:2])
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
        mirrored_valid = correspondence.mirrored_valid[box]
        part = bounding_box(mirrored_valid > 0)
        if part is not None:
            # The mirror image has its validity as weight, the point itself the rest of its own.
            direct = correspondence.valid[box][part] * (1 - mirrored_valid[part])
            weight = mirrored_valid[part] / np.maximum(mirrored_valid[part] + direct, 1e-6)
            weight = weight.reshape(*weight.shape, *[1] * (values.ndim - 2))
            window[part] += weight * (at(correspondence.mirrored[box][part]) - window[part])
    out[box] = window
    return out


def _median_step(places: FloatArray, inside: FloatArray) -> float:
    """Median number of reference pixels between neighbouring input pixels of the face.

    It is one number for the whole face, so every fourth pixel of a large picture is enough.
    """
    sparse = (slice(None, None, 4 if min(inside.shape) > 64 else 1),) * 2
    both = (inside[1:, 1:][sparse] > 0) & (inside[:-1, :-1][sparse] > 0)
    if not both.any():
        return 1.0
    diagonal = places[1:, 1:][sparse] - places[:-1, :-1][sparse]
    return float(np.median(np.hypot(diagonal[..., 0], diagonal[..., 1])[both])) / float(np.sqrt(2))
