"""Labels for every pixel (paper, section 2): seeds from geometry and hair, small classifiers for the rest.

Seeds: the conservative mask is face, what is outside of the aggressive mask and no hair is background, hair found
within the normal mask is hair; or a cue says roughly where all of them are. From there this photo's skin, hair,
backdrop and clothes are learnt; each pixel's class follows from how like them it looks, from where it is, and from its
neighbours; then they are learnt again from what was found.
"""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node
from graphface.nodes.masks.connected import connected
from graphface.nodes.masks.features import PixelFeatures
from graphface.nodes.masks.hair import SKIN_ROOM, Hair
from graphface.nodes.masks.likeness import Likeness, Model, likeness_of
from graphface.nodes.masks.prior import BACKDROP, CLOTHES, FACE, HAIR, layout_of
from graphface.nodes.masks.smoothing import Smoothing, smoothed
from graphface.nodes.masks.start import start_from_cue, start_from_place
from graphface.nodes.types import FloatArray, HeadMasks, Image, Landmarks, Segmentation

Scores = FloatArray
"""h x w x 4, in the order FACE, HAIR, BACKDROP, CLOTHES."""


OPENNESS = 0.02
"""Share of any class that may look like anything."""


DOUBT = 0.25
"""Pixels of anything beside those that teach a class, in squared inter-ocular distances: a class of next to no sample
is told by its place. Half as much lets the few pixels of backdrop in a tight crop jump."""


TEACHING = (0.15, 0.25)
"""Belief in a class up to which a pixel does not teach it, and from which it teaches in proportion. A pixel that
crosses the first comes in with no weight, so that no noise can move it in or out at a stroke. Wider slopes, which count
only the excess, measure a little better on path-traced heads and lose half of the long hair of several portraits."""


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
    evidence: Annotated[float, Field(gt=0, le=4)] = 1.0,
    smoothing: Smoothing = "mean_field",
    rounds: Annotated[int, Field(ge=1, le=10)] = 2,
) -> Segmentation:
    """Face, hair and background of a whole photo, from classifiers that learn on it.

    Args:
        features: of the photo. masks, hair: the seeds. photo: guides the smoothing.
        cue: where the labels are, roughly (see `masks.cue`); None: where they tend to be (see `masks.prior`).
        model: "parzen" densities, or the paper's "mixture" of Gaussians (see `masks.likeness`).
        components: Gaussians in each mixture.
        prior: weight of where things are expected; 0 asks color and texture alone.
        evidence: weight of color and texture.
        smoothing: "none", "guided" (edge-preserving filter of the probabilities) or "mean_field" (neighbours of like
            color want the same label).
        rounds: times that the classes are learnt.

    Returns:
        Soft labels of the photo's size that sum to 1. Outside of the window that was looked at: background.
    """
    window, values = features.window, features.values
    layout = layout_of(landmarks, window)
    unit = max(landmarks.interocular * window.scale, 1e-3)
    pixels = window.shrunk(photo.pixels)
    sure = window.shrunk(masks.conservative) > 0.5
    response = window.shrunk(hair.response)
    aggressive = window.shrunk(masks.aggressive)
    told = None if cue is None else (window.shrunk(cue.face), window.shrunk(cue.hair))
    if told is None:
        start = start_from_place(values, layout, sure, aggressive, response, unit, prior)
    else:
        start = start_from_cue(*told, layout, sure, aggressive, response, prior)
    belief, likeness = start.belief, likeness_of(values, model, components)
    for _ in range(rounds):
        scores = start.expected + evidence * _likelihoods(likeness, belief, start.skin, DOUBT * unit**2)
        scores[sure] = _certain(FACE)
        belief = smoothed(scores, pixels, method=smoothing)
        belief[sure] = np.eye(4, dtype=np.float32)[FACE]
    belief = connected(belief, layout, unit, told)
    shape = masks.normal.shape
    face, locks = (window.enlarged(belief[..., k], shape, beyond=0) for k in (FACE, HAIR))
    return Segmentation(face, locks, np.maximum(1 - face - locks, 0))


def _certain(label: int) -> FloatArray:
    return np.where(np.arange(4) == label, 0, -60).astype(np.float32)


def _likelihoods(likeness: Likeness, belief: FloatArray, skin: FloatArray | None, doubt: float) -> Scores:
    """log p(features | class) of every pixel; a class without samples is told by nothing but its place.

    Args:
        skin: what teaches face (n,); None: what is believed to be face, as with the other classes.
    """
    learnt = []
    for label in (FACE, HAIR, BACKDROP, CLOTHES):
        if label == FACE and skin is not None:
            learnt.append(likeness.log_density(skin, doubt=doubt, room=SKIN_ROOM))
            continue
        weights = belief[..., label].reshape(-1)
        weights = weights * np.clip((weights - TEACHING[0]) / (TEACHING[1] - TEACHING[0]), 0, 1)
        learnt.append(likeness.log_density(weights, doubt=doubt))
    # What a class does not know it is a little open to: a broad Gaussian of the whole window bounds every ratio.
    anything = likeness.anything + np.log(OPENNESS)
    scores = [np.logaddexp(one, anything) for one in learnt]
    return np.stack(scores, axis=1).reshape(belief.shape).astype(np.float32, copy=False)
