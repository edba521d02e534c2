"""A beard inside a face that was labelled skin is taken out of the skin mask, because hair is not painted.

A segmentation labels everything deep inside the mesh as face, and a beard may have any color. What distinguishes it
from skin is texture: strands give a high local contrast at the scale of a few hundredths of the inter-ocular distance
all over the chin or the upper lip, whereas a wrinkle is a single line.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import Formerly, node
from graphface.nodes.blur import gaussian
from graphface.nodes.bounding_box import Box
from graphface.nodes.color import channel_mean
from graphface.nodes.face_scale import FaceScale, face_scale
from graphface.nodes.types import Features, FloatArray, Landmarks, Mask, Shading

MOUSTACHE = (98, 2, 327, 410, 322, 391, 393, 164, 167, 165, 92, 186)


CHIN = (106, 18, 335, 262, 428, 199, 208, 32)


LOWER_FACE = (98, 327, 427, 207, 288, 397, 379, 400, 152, 176, 150, 172, 58)
"""FaceMesh points whose convex hulls are the upper lip, the chin, and everything that a beard may cover."""


_FLOOR = 0.05
"""Added to intensity before the logarithm: contrast in the dark is noise."""


_LEAST_WEIGHT = 0.05


@node("makeup.beard", formerly=("makeup.shaved",))
def beard(
    skin: Mask,
    shading: Shading,
    features: Features,
    landmarks: Landmarks,
    given: Mask | None = None,
    *,
    contrast: Annotated[float, Field(gt=0, le=2)] = 0.13,
    strand_width: Annotated[float, Field(gt=0, le=1), Formerly("strand")] = 0.025,
    neighborhood: Annotated[float, Field(gt=0, le=1), Formerly("around")] = 0.05,
    least_share: Annotated[float, Field(gt=0, le=1), Formerly("cover")] = 0.33,
    resolution: Annotated[int, Field(ge=16, le=256)] = 100,
) -> Mask:
    """The skin mask without the beard; lips and nose stay in it.

    A pixel is hair where the local standard deviation of the high-pass filtered logarithm of intensity is large. A
    beard is found if enough of the chin, or of the upper lip, is hair.

    Args:
        skin: of `makeup.skin`. shading: the photo's intensity. landmarks: scheme "facemesh468".
        given: a user's mask, which is returned as it is.
        contrast: standard deviation of the logarithm of intensity at which a pixel begins to be hair; at 1.5 times that
            it certainly is. (On 20 portraits cheeks have 0.005 to 0.09, beards 0.15 to 0.4, single wrinkles up to 0.2.)
        strand_width: sigma of the Gaussian of the high-pass filter, in inter-ocular distances.
        neighborhood: sigma of the Gaussian that the standard deviation is taken over, in inter-ocular distances.
        least_share: share of hair on chin or upper lip up to which there is no beard; from 1.1 times that on it is
            certain.
        resolution: pixels per inter-ocular distance of the copy on which hair is looked for.

    Returns:
        The very mask `skin` where no beard is found.
    """
    if given is not None:
        return given
    box = _lower_face_box(landmarks, skin.shape)
    if box is None:
        return skin
    copy = face_scale(landmarks, skin[box].shape, resolution)

    def hull(points: tuple[int, ...]) -> FloatArray:
        return _filled_hull(landmarks, points, box, copy)

    def smooth(values: FloatArray, width: float) -> FloatArray:
        return gaussian(values, width * copy.interocular)

    intensity = copy.down(channel_mean(shading[box]))
    parts = copy.down(np.minimum(features.any_of("mouth", "lips", "nose"), 1)[box])
    # The outlines of lips and nose have contrast, too, and are left out.
    weight = (1 - np.clip(2 * smooth(parts, strand_width), 0, 1)) * copy.down(skin[box])
    deviation = _local_contrast(intensity, weight, strand_width, neighborhood, smooth)
    hair = np.asarray(np.clip((deviation / np.float32(contrast) - 1) * 2, 0, 1) * (1 - parts), np.float32)
    moustache, chin = (_confidence(_mean(hair, hull(part) * weight), least_share) for part in (MOUSTACHE, CHIN))
    if max(moustache, chin) == 0:
        return skin
    # Without hair on the chin only the upper lip counts: the smile folds beside it have contrast, too.
    near = [c * smooth(hull(part), 2 * neighborhood) for c, part in ((moustache, MOUSTACHE), (chin, LOWER_FACE))]
    hair *= np.clip(2 * np.maximum(*near), 0, 1)
    without = skin.copy()
    without[box] *= 1 - copy.up(hair)
    return without


def _local_contrast(
    intensity: FloatArray,
    weight: FloatArray,
    strand_width: float,
    neighborhood: float,
    smooth: Callable[[FloatArray, float], FloatArray],
) -> FloatArray:
    """Weighted local standard deviation of the high-pass filtered logarithm of intensity."""
    level = np.log(np.maximum(intensity, 0) + np.float32(_FLOOR))
    fine = level - smooth(level, strand_width)
    variance = smooth(fine * fine * weight, neighborhood)
    return np.sqrt(variance / np.maximum(smooth(weight, neighborhood), _LEAST_WEIGHT))


def _mean(values: FloatArray, weight: FloatArray) -> float:
    """Weighted mean; 0 if less than one pixel has a weight."""
    return float((values * weight).sum() / max(float(weight.sum()), 1.0))


def _confidence(share: float, least: float) -> float:
    """0 up to the least share, 1 from 1.1 times that on: a ramp, so that noise makes no beard appear at once."""
    return float(np.clip(10 * (share / least - 1), 0, 1))


def _filled_hull(landmarks: Landmarks, points: tuple[int, ...], box: Box, copy: FaceScale) -> FloatArray:
    """The convex hull of some landmarks, 1 inside and 0 outside, on the copy of the box."""
    import cv2

    rows, columns = box
    corners = (landmarks.points[list(points), :2] - (columns.start, rows.start)) * copy.scale
    filled = np.zeros(copy.size, np.uint8)
    cv2.fillConvexPoly(filled, cv2.convexHull(np.round(corners).astype(np.int32)), 1)
    return filled.astype(np.float32)


def _lower_face_box(landmarks: Landmarks, shape: tuple[int, ...]) -> Box | None:
    """The part of the picture in which a beard may lie, with a margin; None where that is empty."""
    points, margin = landmarks.points[list(LOWER_FACE), :2], 0.3 * landmarks.interocular
    if not np.isfinite(points).all():
        return None
    (x0, y0), (x1, y1) = points.min(axis=0) - margin, points.max(axis=0) + margin
    top, bottom = (int(np.clip(y, 0, shape[0])) for y in (y0, y1))
    left, right = (int(np.clip(x, 0, shape[1])) for x in (x0, x1))
    return (slice(top, bottom), slice(left, right)) if bottom > top and right > left else None
