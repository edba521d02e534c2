"""Labels for every pixel (paper, section 2): seeds from geometry and hair, small classifiers for the rest.

The seeds are the conservative mask (face), the outside of the aggressive mask without hair (background) and the hair
that was found within the normal mask; or a prior segmentation gives them. From these samples the densities of this
photo's skin, hair, backdrop and clothes are learned. Each pixel's class follows from the likelihood of its features,
the prior of its place, and its neighbors. The densities are then learned again from the result.
"""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import Formerly, node
from graphface.nodes.masks.connected import connected
from graphface.nodes.masks.density import DensityModel, Model, density_model
from graphface.nodes.masks.features import PixelFeatures
from graphface.nodes.masks.hair import SKIN_LIGHTNESS_SPREAD, Hair
from graphface.nodes.masks.initialization import initial_from_geometry, initial_from_segmentation
from graphface.nodes.masks.layout import layout_of
from graphface.nodes.masks.prior import BACKDROP, CLOTHES, FACE, HAIR
from graphface.nodes.masks.smoothing import Smoothing, smoothed
from graphface.nodes.types import FloatArray, HeadMasks, Image, Landmarks, Segmentation

OUTLIER_SHARE = 0.02
"""Every class is mixed with this share of the marginal density, which bounds all likelihood ratios: features that a
class has never seen remain possible."""


PSEUDO_COUNT = 0.25
"""Pseudo-count of each class's density, in squared inter-ocular distances. The density of a class with next to no
samples is nearly the marginal one, so its pixels follow from the prior. With half as much, the labels of a tight crop
that shows few pixels of backdrop jump."""


SAMPLE_RANGE = (0.15, 0.25)
"""Probability of a class up to which a pixel is not a sample of it, and from which it is a sample of that weight. The
ramp between begins at weight 0, so that noise cannot add or remove a sample at once. Wider ramps, which count only the
excess, measure a little better on path-traced heads and lose half of the long hair of several portraits."""


@node("masks.classify")
def classify(
    features: PixelFeatures,
    masks: HeadMasks,
    hair: Hair,
    landmarks: Landmarks,
    photo: Image,
    cue: Segmentation | None = None,
    *,
    model: Model = "parzen",
    components: Annotated[int, Field(ge=1, le=16)] = 4,
    prior: Annotated[float, Field(ge=0, le=4)] = 1.0,
    likelihood: Annotated[float, Field(gt=0, le=4), Formerly("evidence")] = 1.0,
    smoothing: Smoothing = "mean_field",
    rounds: Annotated[int, Field(ge=1, le=10)] = 2,
) -> Segmentation:
    """Face, hair and background of a whole photo, from classifiers that learn on it.

    Args:
        features: of the photo. masks, hair: the seeds. photo: guides the smoothing.
        cue: a prior segmentation (see `masks.cue`). None: the prior follows from geometry alone (see `masks.prior`).
        model: "parzen" (kernel density), or the paper's "mixture" of Gaussians (see `masks.density`).
        components: Gaussians in each mixture.
        prior: weight of the prior; 0 uses color and texture alone.
        likelihood: weight of color and texture.
        smoothing: "none", "guided" (edge-preserving filter of the probabilities) or "mean_field" (a random field in
            which neighbors of similar color prefer the same label).
        rounds: of learning.

    Returns:
        Soft labels of the photo's size that sum to 1. Background outside the window of the features.
    """
    window, values = features.window, features.values
    layout = layout_of(landmarks, window)
    unit = max(landmarks.interocular * window.scale, 1e-3)
    pixels = window.downsampled(photo.pixels)
    conservative = window.downsampled(masks.conservative) > 0.5
    found_hair = window.downsampled(hair.response)
    aggressive = window.downsampled(masks.aggressive)
    segmentation = None if cue is None else (window.downsampled(cue.face), window.downsampled(cue.hair))
    if segmentation is None:
        initial = initial_from_geometry(values, layout, conservative, aggressive, found_hair, unit, prior)
    else:
        initial = initial_from_segmentation(*segmentation, layout, conservative, aggressive, found_hair, prior)
    probabilities, density = initial.probabilities, density_model(values, model, components)
    for _ in range(rounds):
        scores = initial.log_prior + likelihood * _log_likelihoods(
            density, probabilities, initial.skin, PSEUDO_COUNT * unit**2
        )
        scores[conservative] = np.where(np.arange(4) == FACE, 0, -60)
        probabilities = smoothed(scores, pixels, method=smoothing)
        probabilities[conservative] = np.eye(4, dtype=np.float32)[FACE]
    probabilities = connected(probabilities, layout, unit, segmentation)
    shape = masks.normal.shape
    face_mask, hair_mask = (window.upsampled(probabilities[..., k], shape, outside=0) for k in (FACE, HAIR))
    return Segmentation(face_mask, hair_mask, np.maximum(1 - face_mask - hair_mask, 0))


def _log_likelihoods(
    density: DensityModel, probabilities: FloatArray, skin: FloatArray | None, pseudo_count: float
) -> FloatArray:
    """log p(features | class) of every pixel, h x w x 4 in the order FACE, HAIR, BACKDROP, CLOTHES.

    Args:
        probabilities: h x w x 4, whose pixels are the samples.
        skin: (n,) weights of the samples of face; None: by their probability, as for the other classes.
    """
    learned = []
    for label in (FACE, HAIR, BACKDROP, CLOTHES):
        if label == FACE and skin is not None:
            learned.append(density.log_density(skin, pseudo_count=pseudo_count, lightness_spread=SKIN_LIGHTNESS_SPREAD))
            continue
        weights = probabilities[..., label].reshape(-1)
        weights = weights * np.clip((weights - SAMPLE_RANGE[0]) / (SAMPLE_RANGE[1] - SAMPLE_RANGE[0]), 0, 1)
        learned.append(density.log_density(weights, pseudo_count=pseudo_count))
    outlier = density.log_marginal + np.log(OUTLIER_SHARE)
    scores = [np.logaddexp(one, outlier) for one in learned]
    return np.stack(scores, axis=1).reshape(probabilities.shape).astype(np.float32, copy=False)
