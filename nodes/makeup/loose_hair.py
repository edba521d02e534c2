"""Hair that hangs over a reference's face and was labelled skin.

A segmentation trusts the mesh: deep inside it all is face, or a painted cheek would be lost. A strand over an eye or a
cheek is then taken for skin, and its color for makeup. What tells it from paint is that it goes on into labelled hair
without a change of color. For a reference that is enough to leave it: what stands in is the other half of the face.
"""

from __future__ import annotations

from typing import Annotated

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from graphface import node
from graphface.nodes.face_scale import face_scale
from graphface.nodes.types import Features, FloatArray, Image, Landmarks, Mask, Segmentation

_LEAST_PIXELS = 30
"""Of hair and of skin, on the small copy: with fewer nothing is learnt."""


_NOISE = 0.02
"""Least standard deviation of a color channel."""


@node("makeup.uncovered")
def uncovered(
    skin: Mask,
    photo: Image,
    labels: Segmentation,
    features: Features,
    landmarks: Landmarks,
    given: Mask | None = None,
    *,
    resolution: Annotated[int, Field(ge=8, le=256)] = 40,
    apart: Annotated[float, Field(ge=0)] = 2.0,
    margin: Annotated[float, Field(ge=0, le=1)] = 0.04,
) -> Mask:
    """The skin without the hair in front of it.

    Colors of hair (near the face) and skin (nose, cheeks) are a Gaussian each; what is likelier hair and goes on into
    labelled hair is no skin. Eyes, lids, brows and lips are left alone.

    Args:
        skin: of `makeup.skin`. photo, labels, features, landmarks: of the same picture.
        given: a user's mask, taken as it is.
        resolution: pixels per inter-ocular distance of the copy on which it is decided.
        apart: distance of the two mean colors, in standard deviations, below which nothing is told.
        margin: width by which what is found is grown, in inter-ocular distances.
    """
    import cv2

    if given is not None:
        return given
    copy = face_scale(landmarks, skin.shape, resolution)
    unit, small = copy.interocular, copy.down
    pixels = np.asarray(cv2.GaussianBlur(small(photo.pixels), (0, 0), max(0.03 * unit, 0.5)), np.float32)
    hair, bare = small(labels.hair) > 0.8, small(skin) > 0.9
    # Eye shadow may have the hair's color and reach it.
    special = small(features.any_of("eyes", "mouth", "lips")) > 0.2
    special |= small(np.maximum(features.lids, features.brows)) > 0.6
    sure = bare & ~special & (small(np.maximum(features.nose, features.cheeks)) > 0.5)
    near = hair & (cv2.distanceTransform((~bare).astype(np.uint8), cv2.DIST_L2, 3) < 0.8 * unit)
    if min(sure.sum(), near.sum()) < _LEAST_PIXELS:
        return skin
    likelier = _likelier(pixels, near, sure, apart)
    if likelier is None:
        return skin
    strand = _connected(likelier & ~special & ~sure, hair) & ~hair
    if not strand.any():
        return skin
    kernel = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (2 * max(1, round(margin * unit)) + 1,) * 2)
    found = cv2.dilate(strand.astype(np.float32), kernel) * (1 - special)
    found = cv2.GaussianBlur(found.astype(np.float32), (0, 0), max(0.02 * unit, 0.5))
    return np.asarray(skin * (1 - copy.up(np.asarray(found, np.float32))), np.float32)


def _likelier(
    pixels: FloatArray, hair: NDArray[np.bool_], skin: NDArray[np.bool_], apart: float
) -> NDArray[np.bool_] | None:
    """Where the hair's Gaussian is above the skin's; None where the two are too near to tell."""
    cost, centres, inverses = [], [], []
    # A Gaussian's cost: squared distance in its own deviations, plus the logarithm of its volume.
    for where in (hair, skin):
        colors = pixels[where].astype(np.float64)
        covariance = np.cov(colors, rowvar=False) + _NOISE**2 * np.eye(3)
        centre, inverse = np.median(colors, axis=0), np.linalg.inv(covariance)
        off = pixels - centre
        cost.append(np.einsum("hwi,ij,hwj->hw", off, inverse, off) + np.linalg.slogdet(covariance)[1])
        centres.append(centre)
        inverses.append(inverse)
    between = centres[0] - centres[1]
    if min(float(between @ inverse @ between) for inverse in inverses) < apart**2:
        return None
    nearer: NDArray[np.bool_] = cost[0] < cost[1]
    return nearer


def _connected(wanted: NDArray[np.bool_], seed: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """What is wanted and hangs together with the seed."""
    import cv2

    _, label = cv2.connectedComponents((wanted | seed).astype(np.uint8), connectivity=4)
    touched = np.zeros(int(label.max()) + 1, bool)
    touched[label[seed]] = True
    return np.asarray(wanted & touched[label])
