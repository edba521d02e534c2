"""Lips that touch: what the landmarks take for the opening of the mouth, and has the color of the lips, is lip."""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node
from graphface.nodes.blur import gaussian
from graphface.nodes.bounding_box import bounding_box
from graphface.nodes.types import Features, Image, Landmarks

_LEAST_PIXELS = 12


_NOISE = 0.04
"""Standard deviation added to every channel, encoded values."""


_CLOSED, _OPEN = 0.4, 0.6
"""Share of the gap that differs from the lips up to which they touch, and from which on the mouth is open. Gaps
between teeth have the color of lips."""


_GAP, _WIDE = (13, 14), (0.1, 0.13)
"""FaceMesh points in the middle of the lips' inner edges; their distance, in inter-ocular distances, up to which lips
may touch, and from which on the mouth is open whatever it looks like."""


@node("makeup.closed_mouth")
def closed_mouth(
    features: Features,
    photo: Image,
    landmarks: Landmarks,
    *,
    apart: Annotated[float, Field(gt=0, le=10)] = 2.0,
) -> Features:
    """The features with the opening of the mouth cut down to what does not look like the lips around it.

    Between closed lips the landmarks leave a gap of a few hundredths of the inter-ocular distance, up to a tenth.
    Teeth, tongue and the dark of an open mouth differ from lips; a dark line between lips stays an opening.

    Args:
        photo, landmarks: that the features belong to.
        apart: Mahalanobis distance from the color of the lips from which on a pixel begins to be an opening; from 1.75
            times that on it is one.
    """
    box = bounding_box(np.maximum(features.mouth, features.lips) > 0.02)
    if box is None:
        return features
    lips, mouth = features.lips[box], features.mouth[box]
    certain = lips > 0.8
    if certain.sum() < _LEAST_PIXELS:
        return features
    pixels = gaussian(np.log(np.maximum(photo.pixels[box], 0) + np.float32(0.05)), 0.006 * landmarks.interocular)
    colors = pixels[certain].astype(np.float64)
    covariance = np.cov(colors, rowvar=False) + _NOISE**2 * np.eye(3)
    off = pixels - np.median(colors, axis=0)
    distance = np.sqrt(np.maximum(np.einsum("hwi,ij,hwj->hw", off, np.linalg.inv(covariance), off), 0))
    unlike = np.asarray(np.clip((distance / apart - 1) / 0.75, 0, 1), np.float32)
    share = float((unlike * mouth).sum() / max(float(mouth.sum()), 1e-6))
    gap = float(np.nan_to_num(np.linalg.norm(np.diff(landmarks.points[list(_GAP), :2], axis=0))))
    wide = gap / max(landmarks.interocular, 1e-3)
    closed = np.clip((_OPEN - share) / (_OPEN - _CLOSED), 0, 1) * np.clip(
        (_WIDE[1] - wide) / (_WIDE[1] - _WIDE[0]), 0, 1
    )
    open_ = np.asarray(1 - closed * (1 - unlike), np.float32)
    new_mouth, new_lips = features.mouth.copy(), features.lips.copy()
    new_mouth[box] = mouth * open_
    new_lips[box] = np.maximum(lips, mouth * (1 - open_))
    return replace(features, mouth=new_mouth, lips=new_lips)
