"""From what a network says on the crop of a face to a shadow on the photo."""

from __future__ import annotations

import numpy as np

from graphface.nodes.blur import gaussian, normalized
from graphface.nodes.color import channel_mean
from graphface.nodes.disc import disc
from graphface.nodes.landmark_schemes import ibug68
from graphface.nodes.surface.face_crop import INTEROCULAR, SIZE, FaceCrop
from graphface.nodes.types import FloatArray, Image, Landmarks, Mask

_DOUBTFUL, _SURE = 0.5, 0.9
"""Probability from which there is a shadow, and from which it is whole."""

_EDGE = 0.05
"""Radius, in inter-ocular distances, of the filter by which a shadow takes its edges from the photo."""

_EDGE_CONTRAST = 1e-3
"""Variance of the photo's brightness from which that filter keeps an edge."""

_FADE = 0.15
"""Inter-ocular distances at the crop's rim over which a shadow ends."""

_HAIR_REACH, _FEATURE_REACH = 0.1, 0.08
"""Inter-ocular distances about hair, and about eyes, brows and lips."""

_CARRIED = 0.12
"""Standard deviation, in inter-ocular distances, of the Gaussian by which skin beside a feature counts."""

_OUTLINES = (range(36, 42), range(42, 48), range(17, 22), range(22, 27), range(48, 60))
"""Of the 68 landmarks: eyes, brows, lips."""


def cast_shadow(
    crop: FaceCrop, probability: FloatArray, free: FloatArray, photo: Image, landmarks: Landmarks, coverage: Mask
) -> Mask:
    """The shadow at the photo's size, 0..1, its edges where the photo has them; 0 where there is no surface.

    Args:
        probability: of a shadow, SIZE x SIZE. free: 1 where one may be, 0 on hair, SIZE x SIZE.
    """
    import cv2

    cast = np.zeros_like(coverage)
    certain = np.clip((probability - _DOUBTFUL) / (_SURE - _DOUBTFUL), 0, 1)
    certain = carried_over_features(np.asarray(certain, np.float32), crop, landmarks) * free * crop.rim(_FADE)
    if not certain.any():
        return cast
    top, bottom, left, right = window = crop.window(cast.shape)
    on_photo = crop.unwarped(np.asarray(certain, np.float32), window)
    radius = max(1, round(_EDGE * INTEROCULAR / crop.scale))
    brightness = np.nan_to_num(channel_mean(photo.pixels[top:bottom, left:right]), posinf=1)
    filtered = cv2.ximgproc.guidedFilter(np.clip(brightness, 0, 1), on_photo, radius, _EDGE_CONTRAST)
    cast[top:bottom, left:right] = np.clip(filtered, 0, 1) * (coverage[top:bottom, left:right] > 0)
    return cast


def off_hair(hair: FloatArray) -> FloatArray:
    """0 on hair and beside it, 1 farther away, SIZE x SIZE."""
    return _away_from(hair, _HAIR_REACH)


def carried_over_features(shadow: FloatArray, crop: FaceCrop, landmarks: Landmarks) -> FloatArray:
    """A shadow, SIZE x SIZE, that runs over eyes, brows and lips as it does beside them: they are dark in any light."""
    free = _off_features(crop, landmarks)
    beside = normalized(shadow, free, _CARRIED * INTEROCULAR, 0.02)
    return np.asarray(beside + (shadow - beside) * free, np.float32)


def _off_features(crop: FaceCrop, landmarks: Landmarks) -> FloatArray:
    """0 on eyes, brows and lips and beside them, 1 farther away."""
    import cv2

    points = np.asarray(ibug68(landmarks).points[:, :2], np.float64)
    points = np.nan_to_num(points @ crop.matrix[:, :2].T + crop.matrix[:, 2])
    points = np.clip(points, -SIZE, 2 * SIZE)
    drawn = np.zeros((SIZE, SIZE), np.float32)
    for outline in _OUTLINES:
        cv2.fillConvexPoly(drawn, cv2.convexHull(np.round(points[list(outline)]).astype(np.int32)), 1.0)
    return _away_from(drawn, _FEATURE_REACH)


def _away_from(what: FloatArray, reach: float) -> FloatArray:
    """0 on `what` and within `reach` inter-ocular distances of it, 1 farther away."""
    import cv2

    pixels = round(reach * INTEROCULAR)
    return np.asarray(1 - gaussian(np.asarray(cv2.dilate(what, disc(pixels))), pixels / 2), np.float32)
