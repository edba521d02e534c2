"""Where there is skin that may be painted, or whose paint may be taken."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node
from graphface.nodes.types import Features, FloatArray, Landmarks, Mask, Segmentation, Surface


@node("makeup.skin")
def skin(
    labels: Segmentation,
    surface: Surface,
    landmarks: Landmarks,
    features: Features,
    given: Mask | None = None,
    *,
    rim: Annotated[float, Field(ge=0, le=1)] = 0.25,
) -> Mask:
    """The face label (with ears and neck), and all that is deep inside the mesh and no hair, whatever its color.

    A classifier that has learned what skin looks like takes a blue lip or a green stripe for something else. Eyes,
    brows, nose and lips are part of a face; hair hangs in from its outline, so towards that the label decides, and
    where the label says hair it is believed.

    Args:
        labels: of a segmentation. surface, landmarks, features: of the same photo.
        given: a user's mask, taken as it is.
        rim: width of the mesh's rim in which the label alone decides, in inter-ocular distances; the prior rises over
            the same width.
    """
    import cv2

    if given is not None:
        return given
    covered = (surface.coverage > 0.5).astype(np.uint8)
    unit = max(landmarks.interocular, 1e-3)
    depth = np.asarray(cv2.distanceTransform(covered, cv2.DIST_L2, 5), np.float32)
    deep: FloatArray = np.clip(depth / np.float32(max(rim * unit, 1.0)) - 1, 0, 1)
    parts = features.any_of("eyes", "mouth", "lips", "lids", "brows", "nose")
    facial = np.maximum(deep, np.minimum(2 * parts, 1) * surface.coverage)
    return np.asarray(np.maximum(labels.face, facial * (1 - labels.hair)), np.float32)
