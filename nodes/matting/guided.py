"""Soft edges by the guided filter: within every small window alpha is a linear function of the color.

He and Sun, Fast Guided Filter, 2015: the coefficients of the linear functions are computed on a small copy of the
picture, and applied to the colors of the large one, whose edges they follow.
"""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node
from graphface.nodes.bounding_box import bounding_box
from graphface.nodes.face_scale import FaceScale, face_scale
from graphface.nodes.linear_functions import linear_functions
from graphface.nodes.types import FloatArray, Image, Landmarks, Segmentation


@node("matting.guided")
def guided(
    photo: Image,
    labels: Segmentation,
    landmarks: Landmarks,
    *,
    radius: Annotated[float, Field(gt=0, le=2)] = 0.06,
    ridge: Annotated[float, Field(ge=1e-8, le=1)] = 1e-3,
    resolution: Annotated[int, Field(ge=8, le=1024)] = 80,
) -> Segmentation:
    """The labels, aligned with the edges of the photo.

    Args:
        photo: the guide. labels: soft labels; one that is certain over a whole window stays so.
        radius: half the window's side, in inter-ocular distances.
        ridge: He's epsilon, a variance of color; less varied windows are smoothed. A tenth of it lets the noise of a
            photo into alpha, and is no nearer to the truth (hair on path-traced heads: overlap 0.956 at 1e-4, 0.958 at
            1e-3).
        resolution: pixels per inter-ocular distance of the small copy.
    """
    unit = max(landmarks.interocular, 1e-3)
    part = bounding_box(labels.background < 1 - 1e-4, margin=round(2 * radius * unit) + 2)
    if part is None:
        return labels
    guide = np.clip(np.nan_to_num(photo.pixels[part]), 0, 1).astype(np.float32, copy=False)
    alphas = np.stack([labels.face[part], labels.hair[part]], axis=2)
    copy = face_scale(landmarks, guide.shape, resolution)
    side = 2 * max(1, round(radius * copy.interocular)) + 1
    coefficients = linear_functions(copy.down(guide), copy.down(alphas).reshape(*copy.size, 2), side, ridge)
    filtered = np.clip(_applied(coefficients, guide, copy), 0, 1)
    filtered /= np.maximum(filtered[0] + filtered[1], 1)
    face, hair = labels.face.copy(), labels.hair.copy()
    face[part], hair[part] = filtered
    return Segmentation(face, hair, np.maximum(1 - face - hair, 0))


def _applied(coefficients: FloatArray, guide: FloatArray, copy: FaceScale) -> FloatArray:
    """a . color + b for face and hair, with the coefficients upsampled to the guide: 2 x H x W."""
    planes = [copy.up(plane) for plane in np.ascontiguousarray(np.moveaxis(coefficients, 2, 0))]
    channels = [np.ascontiguousarray(guide[..., c]) for c in range(3)]
    for k in range(2):
        for c in range(3):
            planes[4 * k + 3] += planes[4 * k + c] * channels[c]
    return np.stack([planes[3], planes[7]])
