"""A beard in a face that was labelled skin: hair is never painted.

A segmentation trusts the mesh, and a beard may have any color. What tells it from skin is texture: strands are dark
beside bright within a few hundredths of the eyes' distance, and that all over chin or upper lip; a wrinkle is a line.
"""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node
from graphface.nodes.color import channel_mean
from graphface.nodes.face_scale import face_scale
from graphface.nodes.types import Features, FloatArray, Landmarks, Mask, Shading

Length = Annotated[float, Field(gt=0, le=1)]


# Numbers of FaceMesh points: where moustache and chin beard grow, and all that a beard may cover.
MOUSTACHE = (98, 2, 327, 410, 322, 391, 393, 164, 167, 165, 92, 186)


CHIN = (106, 18, 335, 262, 428, 199, 208, 32)


BEARD = (98, 327, 427, 207, 288, 397, 379, 400, 152, 176, 150, 172, 58)


_LEAST_LIGHT = 0.05
"""Added to intensity: in the dark, contrast is noise."""


_LEAST_WEIGHT = 0.05


@node("makeup.shaved")
def shaved(
    skin: Mask,
    shading: Shading,
    features: Features,
    landmarks: Landmarks,
    given: Mask | None = None,
    *,
    contrast: Annotated[float, Field(gt=0, le=2)] = 0.13,
    strand: Length = 0.025,
    around: Length = 0.05,
    cover: Annotated[float, Field(gt=0, le=1)] = 0.33,
    resolution: Annotated[int, Field(ge=16, le=256)] = 100,
) -> Mask:
    """The skin without the beard that grows on it; lips and nose stay.

    Args:
        skin: of `makeup.skin`. shading: the photo's intensity. landmarks: scheme "facemesh468".
        given: a user's mask, taken as it is.
        contrast: standard deviation of the logarithm of intensity at which hair begins; at half as much again it is
            certain. (On 20 portraits cheeks have 0.005 to 0.09, beards 0.15 to 0.4, single wrinkles up to 0.2.)
        strand: what is broader is no strand; around: over which the deviation is taken; in inter-ocular distances.
        cover: share of chin or upper lip that is hair up to which there is none; from a tenth more on it is certain.
        resolution: pixels per inter-ocular distance of the copy on which it is measured.
    """
    import cv2

    if given is not None:
        return given
    window = _box(landmarks, skin.shape)
    if window is None:
        return skin
    rows, columns = window
    copy = face_scale(landmarks, (rows.stop - rows.start, columns.stop - columns.start), resolution)

    def small(values: FloatArray) -> FloatArray:
        return copy.down(values[window])

    def smooth(values: FloatArray, sigma: float) -> FloatArray:
        width = max(sigma * copy.interocular, 0.5)
        return np.asarray(cv2.GaussianBlur(values, (0, 0), width, borderType=cv2.BORDER_REPLICATE), np.float32)

    def patch(points: tuple[int, ...]) -> FloatArray:
        corners = (landmarks.points[list(points), :2] - (columns.start, rows.start)) * copy.scale
        drawn = np.zeros(copy.size, np.uint8)
        cv2.fillConvexPoly(drawn, cv2.convexHull(np.round(corners).astype(np.int32)), 1)
        return drawn.astype(np.float32)

    level = np.log(np.maximum(small(channel_mean(shading)), 0) + np.float32(_LEAST_LIGHT))
    fine = level - smooth(level, strand)
    parts = small(np.minimum(features.any_of("mouth", "lips", "nose"), 1))
    counts = (1 - np.clip(2 * smooth(parts, strand), 0, 1)) * small(skin)  # contours are no strands
    deviation = np.sqrt(smooth(fine * fine * counts, around) / np.maximum(smooth(counts, around), _LEAST_WEIGHT))
    hair = np.asarray(np.clip((deviation / np.float32(contrast) - 1) * 2, 0, 1) * (1 - parts), np.float32)
    lip, chin = (_surely(_share(hair, patch(where) * counts), cover) for where in (MOUSTACHE, CHIN))
    if max(lip, chin) == 0:
        return skin
    # Beside a moustache alone, the folds of a smile are no beard.
    near = (surely * smooth(patch(where), 2 * around) for surely, where in ((lip, MOUSTACHE), (chin, BEARD)))
    hair *= np.clip(2 * np.maximum(*near), 0, 1)
    without = skin.copy()
    without[window] *= 1 - copy.up(hair)
    return without


def _share(found: FloatArray, where: FloatArray) -> float:
    """Mean of what was found over some pixels, 0 without any."""
    return float((found * where).sum() / max(float(where.sum()), 1.0))


def _surely(share: float, cover: float) -> float:
    """0 up to `cover`, 1 from a tenth more on: no noise may bring a beard in at a stroke."""
    return float(np.clip(10 * (share / cover - 1), 0, 1))


def _box(landmarks: Landmarks, shape: tuple[int, ...]) -> tuple[slice, slice] | None:
    """Where a beard may be, with room around, inside of the picture."""
    points, margin = landmarks.points[list(BEARD), :2], 0.3 * landmarks.interocular
    if not np.isfinite(points).all():
        return None
    (x0, y0), (x1, y1) = points.min(axis=0) - margin, points.max(axis=0) + margin
    top, bottom = (int(np.clip(v, 0, shape[0])) for v in (y0, y1))
    left, right = (int(np.clip(v, 0, shape[1])) for v in (x0, x1))
    return (slice(top, bottom), slice(left, right)) if bottom > top and right > left else None
