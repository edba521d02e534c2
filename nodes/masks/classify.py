"""Labels for every pixel (paper, section 2): seeds from geometry and hair, small classifiers for the rest.

Seeds: the conservative mask is face, what is outside of the aggressive mask and no hair is background, hair found
within the normal mask is hair. From the seeds Gaussian mixtures of this photo's skin, hair, backdrop and clothes are
fitted; each pixel's class follows from them, from where it is, and from its neighbours; then the mixtures are fitted
again to what was found.
"""

from __future__ import annotations

from typing import Annotated

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from graphface import node, warn
from graphface.nodes.masks.features import PixelFeatures
from graphface.nodes.masks.hair import Hair, skin_mixture, thinned
from graphface.nodes.masks.head import CHIN, EYE_LINE
from graphface.nodes.masks.mixture import Mixture, fit_mixture
from graphface.nodes.masks.prior import BACKDROP, CLOTHES, FACE, HAIR, Layout, layout_of, log_prior, log_sum_exp
from graphface.nodes.masks.smoothing import Smoothing, smoothed
from graphface.nodes.types import FloatArray, HeadMasks, Image, Landmarks, Mask, Segmentation

Scores = FloatArray
"""h x w x 4, in the order FACE, HAIR, BACKDROP, CLOTHES."""


@node("masks.classify")
def classify(
    features: PixelFeatures,
    masks: HeadMasks,
    hair: Hair,
    landmarks: Landmarks,
    photo: Image,
    *,
    components: Annotated[int, Field(ge=1, le=16)] = 4,
    prior: Annotated[float, Field(ge=0, le=4)] = 1.0,
    evidence: Annotated[float, Field(gt=0, le=4)] = 0.4,
    smoothing: Smoothing = "mean_field",
    rounds: Annotated[int, Field(ge=1, le=10)] = 2,
) -> Segmentation:
    """Face, hair and background of a whole photo, from classifiers that learn on it.

    Args:
        features: of the photo. masks, hair: the seeds. photo: guides the smoothing.
        components: Gaussians in each class.
        prior: weight of where things are expected (see `masks.prior`); 0 asks colour and texture alone.
        evidence: weight of colour and texture. Features of one pixel are not independent, so less than 1.
        smoothing: "none", "guided" (edge-preserving filter of the probabilities) or "mean_field" (neighbours of like
            colour want the same label).
        rounds: times that the mixtures are fitted.

    Returns:
        Soft labels of the photo's size that sum to 1. Outside of the window that was looked at: background.
    """
    window, values = features.window, features.values
    layout = layout_of(landmarks, window)
    pixels = window.shrunk(photo.pixels)
    sure = window.shrunk(masks.conservative) > 0.5
    expected = prior * log_prior(layout)
    belief = _seeds(sure, window.shrunk(masks.aggressive), window.shrunk(hair.mask), layout)
    for _ in range(rounds):
        scores = expected + evidence * _likelihoods(values, belief, sure & ~layout.features, components)
        scores[sure] = _certain(FACE)
        belief = smoothed(scores, pixels, method=smoothing)
        belief[sure] = np.eye(4, dtype=np.float32)[FACE]
    belief = _connected(belief, layout)
    shape = masks.normal.shape
    face, locks = (window.enlarged(belief[..., k], shape, beyond=0) for k in (FACE, HAIR))
    return Segmentation(face, locks, np.maximum(1 - face - locks, 0))


def _certain(label: int) -> FloatArray:
    return np.where(np.arange(4) == label, 0, -60).astype(np.float32)


def _seeds(sure: NDArray[np.bool_], aggressive: FloatArray, hair: FloatArray, layout: Layout) -> FloatArray:
    """First beliefs, h x w x 4, all 0 where nothing is assigned."""
    belief = np.zeros((*sure.shape, 4), np.float32)
    outside = (aggressive < 0.5) & (hair < 0.5)
    low = layout.high < CHIN - 0.35
    belief[..., BACKDROP] = outside & ~low
    belief[..., CLOTHES] = low & (outside | (layout.high < CHIN - 0.8)) & (np.abs(layout.right) < 2.2)
    belief[..., HAIR] = hair * (layout.high > EYE_LINE - 0.3) * ~sure
    belief[..., FACE] = sure
    return belief


def _likelihoods(
    values: FloatArray, belief: FloatArray, skin: NDArray[np.bool_], components: int
) -> Scores:
    """log p(features | class) of every pixel; a class without samples is told by nothing but its place."""
    flat = values.reshape(-1, values.shape[2])
    fitted: list[Mixture | None] = [skin_mixture(values, skin, components)]
    for label in (HAIR, BACKDROP, CLOTHES):
        weights = belief[..., label].reshape(-1)
        chosen = thinned(np.flatnonzero(weights > 0.2))
        fitted.append(fit_mixture(flat[chosen], weights[chosen], components=components + 1))
    found = [None if m is None else m.log_likelihood(flat) for m in fitted]
    known = [f for f in found if f is not None]
    if not known:
        warn("masks.classify: no pixel is surely anything; labels follow from their place alone")
        return np.zeros((*values.shape[:2], 4), np.float32)
    absent = np.minimum.reduce(known) - 5
    scores = np.stack([absent if f is None else f for f in found], axis=1)
    # Far from every class the likelihoods fall without bound; what matters is which class is nearest.
    scores = np.maximum(scores - scores.max(axis=1, keepdims=True), -30)
    return scores.reshape(*values.shape[:2], 4).astype(np.float32, copy=False)


def _connected(belief: FloatArray, layout: Layout) -> FloatArray:
    """Hair that does not hang on the head and face that does not hang on the face become background."""
    belief = belief.copy()
    head = (layout.head < 0) & (layout.high > CHIN)
    for label, root in ((HAIR, head), (FACE, (layout.outline < 0) | (layout.neck < 0) | head)):
        stray = _apart(belief[..., label] > 0.3, root)
        belief[..., BACKDROP] += np.where(stray, belief[..., label], 0)
        belief[..., label] *= ~stray
    return belief


def _apart(region: NDArray[np.bool_], root: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """The connected parts of a region that do not touch the root."""
    import cv2

    count, labels = cv2.connectedComponents(region.astype(np.uint8), connectivity=4)
    touches = np.zeros(count, bool)
    touches[np.unique(labels[region & root])] = True
    return region & ~touches[labels]
