"""Loose hair over the face that was labelled skin is taken out of the skin mask.

A segmentation labels everything deep inside the mesh as face, so that a painted cheek is not lost. A strand over an eye
or a cheek is then labelled skin, and its color would be transferred as makeup. What distinguishes it from paint is that
it has the color of the hair and is connected to labelled hair. In a reference it is enough to leave such pixels out:
the other half of the face takes their place.
"""

from __future__ import annotations

from typing import Annotated

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from graphface import Formerly, node
from graphface.nodes.disc import disc
from graphface.nodes.face_scale import face_scale
from graphface.nodes.types import Features, FloatArray, Image, Landmarks, Mask, Segmentation

_LEAST_PIXELS = 30
"""Pixels of hair, and of skin, on the small copy that a color model is fitted to at the least."""


_NOISE = 0.02
"""Standard deviation added to every color channel: regularizes the covariance of a flat color."""


_NEAR_FACE = 0.8
"""Distance from the skin, in inter-ocular distances, up to which labelled hair is used for the color model."""


@node("makeup.loose_hair", formerly=("makeup.uncovered",))
def loose_hair(
    skin: Mask,
    photo: Image,
    labels: Segmentation,
    features: Features,
    landmarks: Landmarks,
    given: Mask | None = None,
    *,
    resolution: Annotated[int, Field(ge=8, le=256)] = 40,
    separation: Annotated[float, Field(ge=0), Formerly("apart")] = 2.0,
    margin: Annotated[float, Field(ge=0, le=1)] = 0.04,
) -> Mask:
    """The skin mask without the hair in front of the skin.

    One Gaussian models the colors of the hair near the face, another those of the skin on nose and cheeks. A pixel that
    is more likely hair, and connected through such pixels to labelled hair, is not skin. Eyes, lids, brows and lips are
    left alone, because eye shadow may have the hair's color and touch it.

    Args:
        skin: of `makeup.skin`. photo, labels, features, landmarks: of the same picture.
        given: a user's mask, which is returned as it is.
        resolution: pixels per inter-ocular distance of the copy on which pixels are classified.
        separation: Mahalanobis distance of the two mean colors below which hair and skin are not distinguished.
        margin: width by which the hair that was found is dilated, in inter-ocular distances.

    Returns:
        The very mask `skin` where no hair is found.
    """
    import cv2

    if given is not None:
        return given
    copy = face_scale(landmarks, skin.shape, resolution)
    unit, small = copy.interocular, copy.down
    pixels = np.asarray(cv2.GaussianBlur(small(photo.pixels), (0, 0), max(0.03 * unit, 0.5)), np.float32)
    hair, inside = small(labels.hair) > 0.8, small(skin) > 0.9
    protected = small(features.any_of("eyes", "mouth", "lips")) > 0.2
    protected |= small(np.maximum(features.lids, features.brows)) > 0.6
    certain_skin = inside & ~protected & (small(np.maximum(features.nose, features.cheeks)) > 0.5)
    near_hair = hair & (cv2.distanceTransform((~inside).astype(np.uint8), cv2.DIST_L2, 3) < _NEAR_FACE * unit)
    if min(certain_skin.sum(), near_hair.sum()) < _LEAST_PIXELS:
        return skin
    likely_hair = _more_likely(pixels, near_hair, certain_skin, separation)
    if likely_hair is None:
        return skin
    strands = _connected(likely_hair & ~protected & ~certain_skin, hair) & ~hair
    if not strands.any():
        return skin
    grown = cv2.dilate(strands.astype(np.float32), disc(max(1, margin * unit)))
    found = np.asarray(grown * (1 - protected), np.float32)
    found = np.asarray(cv2.GaussianBlur(found, (0, 0), max(0.02 * unit, 0.5)), np.float32)
    return np.asarray(skin * (1 - copy.up(found)), np.float32)


def _more_likely(
    pixels: FloatArray, hair: NDArray[np.bool_], skin: NDArray[np.bool_], separation: float
) -> NDArray[np.bool_] | None:
    """Where the density of the hair's Gaussian exceeds that of the skin's; None where the two are not separated."""
    costs, means, inverses = [], [], []
    for where in (hair, skin):
        colors = pixels[where].astype(np.float64)
        covariance = np.cov(colors, rowvar=False) + _NOISE**2 * np.eye(3)
        mean, inverse = np.median(colors, axis=0), np.linalg.inv(covariance)
        off = pixels - mean
        # -2 log density, up to a constant: squared Mahalanobis distance + log |covariance|
        costs.append(np.einsum("hwi,ij,hwj->hw", off, inverse, off) + np.linalg.slogdet(covariance)[1])
        means.append(mean)
        inverses.append(inverse)
    difference = means[0] - means[1]
    if min(float(difference @ inverse @ difference) for inverse in inverses) < separation**2:
        return None
    more_likely: NDArray[np.bool_] = costs[0] < costs[1]
    return more_likely


def _connected(candidates: NDArray[np.bool_], seeds: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """The candidates that are connected to a seed through candidates and seeds (4-neighbourhood)."""
    import cv2

    _, label = cv2.connectedComponents((candidates | seeds).astype(np.uint8), connectivity=4)
    with_seed = np.zeros(int(label.max()) + 1, bool)
    with_seed[label[seeds]] = True
    return np.asarray(candidates & with_seed[label])
