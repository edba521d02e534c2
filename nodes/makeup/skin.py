"""The skin that may be painted, or from which makeup may be taken."""

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
    """The label face (with ears and neck), and everything deep inside the mesh that is not labelled hair.

    A classifier that has learnt the color of skin labels a blue lip or a green stripe as something else, so geometry
    counts as well: eyes, brows, nose and lips always belong to a face, and so does what is deep inside the mesh. Hair
    falls over the outline of the face, so near the outline the label alone decides.

    Args:
        labels: of a segmentation. surface, landmarks, features: of the same photo.
        given: a user's mask, which is returned as it is.
        rim: width of the mesh's rim in which the label alone decides, in inter-ocular distances. Inside of it the
            weight of the geometry rises from 0 to 1 over the same width.
    """
    import cv2

    if given is not None:
        return given
    covered = (surface.coverage > 0.5).astype(np.uint8)
    unit = max(landmarks.interocular, 1e-3)
    depth = np.asarray(cv2.distanceTransform(covered, cv2.DIST_L2, 5), np.float32)
    deep: FloatArray = np.clip(depth / np.float32(max(rim * unit, 1.0)) - 1, 0, 1)
    parts = features.any_of("eyes", "mouth", "lips", "lids", "brows", "nose")
    by_geometry = np.maximum(deep, np.minimum(2 * parts, 1) * surface.coverage)
    return np.asarray(np.maximum(labels.face, by_geometry * (1 - labels.hair)), np.float32)
