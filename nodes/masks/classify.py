"""Labels for every pixel (paper, section 2): seeds from geometry and hair, small classifiers for the rest.

Seeds: the conservative mask is face, what is outside of the aggressive mask and no hair is background, hair found
within the normal mask is hair. From the seeds this photo's skin, hair, backdrop and clothes are learnt; each pixel's
class follows from how like them it looks, from where it is, and from its neighbours; then they are learnt again from
what was found.
"""

from __future__ import annotations

from typing import Annotated

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from graphface import node
from graphface.nodes.masks.features import PixelFeatures
from graphface.nodes.masks.hair import SKIN_ROOM, Hair
from graphface.nodes.masks.head import CHIN, EYE_LINE
from graphface.nodes.masks.likeness import Likeness, Model, likeness_of
from graphface.nodes.masks.prior import BACKDROP, CLOTHES, FACE, HAIR, Layout, layout_of
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

STRIP = 0.06
"""Width of the thinnest hair that can carry more hair, in inter-ocular distances."""

GAP = 8.0
"""Price of an inter-ocular distance through what is surely no hair, on the way from the head to a lock."""

COLLAR, INWARDS = 8.0, 0.15
"""Price of an inter-ocular distance through hair, for each that the way lies inside of the neck, counted from this far
outside of it. Locks fall beside the neck; what hangs on the head only by way of the throat is a collar or a suit."""

WAYS = 400
"""Longest way that is looked for, working pixels."""


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
        prior: weight of where things are expected; 0 asks colour and texture alone.
        evidence: weight of colour and texture.
        smoothing: "none", "guided" (edge-preserving filter of the probabilities) or "mean_field" (neighbours of like
            colour want the same label).
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
    told = None if cue is None else (window.shrunk(cue.face), window.shrunk(cue.hair))
    if told is None:
        start = start_from_place(values, layout, sure, window.shrunk(masks.aggressive), response, unit, prior)
    else:
        start = start_from_cue(*told, layout, sure, response, prior)
    belief, likeness = start.belief, likeness_of(values, model, components)
    for _ in range(rounds):
        scores = start.expected + evidence * _likelihoods(likeness, belief, start.skin, DOUBT * unit**2)
        scores[sure] = _certain(FACE)
        belief = smoothed(scores, pixels, method=smoothing)
        belief[sure] = np.eye(4, dtype=np.float32)[FACE]
    belief = _connected(belief, layout, unit, told)
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


def _connected(
    belief: FloatArray, layout: Layout, unit: float, told: tuple[FloatArray, FloatArray] | None
) -> FloatArray:
    """Hair that does not hang on the head becomes skin or background, face that does not hang on the face background.

    What hangs by a strip thinner than `STRIP` does not hang: the shadow of a jaw may tie a dark suit to dark hair.

    Args:
        told: a cue's probabilities of face and hair. What it is sure of needs not hang: it saw the whole head, and a
            lock behind a shadow hangs by so little that noise would cut it off.
    """
    belief = belief.copy()
    head = (layout.head < 0) & (layout.high > CHIN + 0.5)
    throat = (layout.outline < 0.05) | ((layout.neck < 0.05) & (layout.high > CHIN - 0.3))
    skin = (layout.outline < 0) | (layout.neck < 0) | head
    collar = COLLAR * np.maximum(INWARDS - layout.neck, 0) * (layout.outline > 0) * (layout.high < CHIN + 0.3)
    for label, root, stays, toll in (
        (HAIR, head & (layout.high > EYE_LINE), head, collar),
        (FACE, skin, skin, np.zeros_like(collar)),
    ):
        stray = belief[..., label] * apart(belief[..., label], root, unit, toll) * ~stays
        if told is not None:
            stray *= np.clip(1 - 2 * told[label], 0, 1)
        belief[..., label] -= stray
        shadow = throat if label == HAIR else np.zeros_like(throat)
        belief[..., FACE] += stray * shadow
        belief[..., BACKDROP] += stray * ~shadow
    return belief


def apart(belief: FloatArray, root: NDArray[np.bool_], unit: float, toll: FloatArray | None = None) -> FloatArray:
    """How surely each pixel of a label does not hang on the root, float32 h x w in [0, 1].

    The cheapest way from the root is found, on which every step costs the square of what belief lacks of 1. A part of
    the label hangs on the root where that is less than 1/4, and does not where it is more than 3/4. A sum along a way
    moves little with noise, where a threshold would cut a thin lock off at one pixel.

    Args:
        belief: h x w in [0, 1]. root: where ways start. unit: inter-ocular distance in pixels.
        toll: h x w, what an inter-ocular distance costs beside that.
    """
    import cv2

    thin = max(0, round(STRIP * unit / 2))
    element = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (2 * thin + 1, 2 * thin + 1))
    lacking = np.square(1 - np.asarray(cv2.erode(belief, element, borderType=cv2.BORDER_REPLICATE), np.float32))
    price = np.asarray((GAP * lacking + (0 if toll is None else toll)) / max(unit, 1.0), np.float32)
    way = np.where(root, 2 * lacking, 9).astype(np.float32)
    for step in range(1, WAYS + 1):
        shorter = np.minimum(way, np.asarray(cv2.erode(way, np.ones((3, 3), np.uint8))) + price)
        if step % 8 == 0 and np.abs(shorter - way).max() < 1e-3:
            break
        way = shorter
    way = np.asarray(cv2.erode(way, element, iterations=2), np.float32)
    return np.asarray(np.clip(2 * way - 0.5, 0, 1), np.float32)
