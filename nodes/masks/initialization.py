"""The initial state of a photo's classifiers: prior scores of every pixel, and the weights of the first samples.

Either from geometry and the paper's seeds (`initial_from_geometry`), or from a prior segmentation of the photo
(`initial_from_segmentation`).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.head_shape import CHIN, EYE_LINE
from graphface.nodes.masks.exposed_skin import exposed_skin
from graphface.nodes.masks.layout import Layout
from graphface.nodes.masks.logits import log_softmax, softmax
from graphface.nodes.masks.prior import BACKDROP, CLOTHES, FACE, HAIR, log_prior
from graphface.nodes.masks.skin_color import skin_weights
from graphface.nodes.types import FloatArray

EXPOSED_SKIN_SCORE = 6.0
"""Added to the score of face, and subtracted from the score of hair, where skin surely continues the forehead."""


NO_HAIR_SCORE = 6.0
"""Subtracted from the score of hair everywhere where the detector found none. It fades as the most certain pixel of
hair goes from 0 to 1/2."""


SEGMENTATION_WEIGHT = 0.5
"""Weight of a prior segmentation's log probabilities beside the likelihoods of colors: the network saw the photo at low
resolution, and its edges are uncertain. On photos and heads outside its training set any weight from 0.35 to 0.7 is
within 0.004 of the best."""


MIN_PROBABILITY = 1e-4
"""Least probability of any label in a prior segmentation, so that colors can overrule it."""


@dataclass(frozen=True)
class InitialLabels:
    """What classification starts from; h x w x 4 in the order FACE, HAIR, BACKDROP, CLOTHES.

    `log_prior`: scores that stay the same in all rounds. `probabilities`: weights of the first samples. `skin` (n,):
    weight of each pixel as a sample of face in all rounds; None where that is its current probability of face.
    """

    log_prior: FloatArray
    probabilities: FloatArray
    skin: FloatArray | None


def initial_from_geometry(
    values: FloatArray,
    layout: Layout,
    conservative: NDArray[np.bool_],
    aggressive: FloatArray,
    hair: FloatArray,
    unit: float,
    weight: float,
) -> InitialLabels:
    """From the prior over classes and the paper's seeds.

    The conservative mask is face, the outside of the aggressive mask is background, and the detector finds hair.

    Args:
        values: features h x w x D. conservative: the conservative mask. hair: response of the hair detector.
        unit: inter-ocular distance in pixels. weight: of the prior's scores.
    """
    exposed = exposed_skin(values, conservative & ~layout.features, layout, unit)
    skin = (conservative & ~layout.features) | (exposed > 0.5)
    scores = weight * log_prior(layout)
    scores[..., FACE] += EXPOSED_SKIN_SCORE * exposed
    scores[..., HAIR] -= EXPOSED_SKIN_SCORE * exposed
    probabilities = _seeds(conservative, aggressive, hair, layout)
    scores[..., HAIR] -= NO_HAIR_SCORE * max(0.0, 1 - 2 * float(probabilities[..., HAIR].max()))
    return InitialLabels(scores, probabilities, skin_weights(values, skin))


def initial_from_segmentation(
    face: FloatArray,
    hair: FloatArray,
    layout: Layout,
    conservative: NDArray[np.bool_],
    aggressive: FloatArray,
    certain_hair: FloatArray,
    weight: float,
) -> InitialLabels:
    """From a prior segmentation; the prior over classes divides its background into backdrop and clothes.

    Args:
        face, hair: probabilities in the prior segmentation, h x w.
        conservative: the conservative mask, which is face.
        aggressive: pixels outside this mask are no first samples of face.
        certain_hair: hair by the detector or by the user; it replaces the segmentation's hair in the first samples.
        weight: of the segmentation's log probabilities, beside `SEGMENTATION_WEIGHT`.
    """
    of_background = log_softmax(log_prior(layout)[..., BACKDROP:])
    given = np.log(np.clip(np.dstack([face, hair, 1 - face - hair]), MIN_PROBABILITY, 1))
    scores = np.dstack([given[..., :BACKDROP], given[..., BACKDROP:] + of_background])
    scores = np.asarray(weight * SEGMENTATION_WEIGHT * scores, np.float32)
    probabilities = softmax(scores)
    probabilities[..., FACE] *= aggressive
    probabilities[..., HAIR] = 0
    probabilities *= ((1 - certain_hair) / np.maximum(probabilities.sum(axis=2), 1e-6))[..., None]
    probabilities[..., HAIR] = certain_hair
    probabilities[conservative] = np.eye(4, dtype=np.float32)[FACE]
    return InitialLabels(scores, np.asarray(probabilities, np.float32), None)


def _seeds(conservative: NDArray[np.bool_], aggressive: FloatArray, hair: FloatArray, layout: Layout) -> FloatArray:
    """The paper's seeds as weights of samples, h x w x 4; all 0 where a pixel belongs to no seed."""
    weights = np.zeros((*conservative.shape, 4), np.float32)
    outside = (aggressive < 0.5) * (1 - hair)
    low = layout.up < CHIN - 0.35
    weights[..., BACKDROP] = outside * ~low
    weights[..., CLOTHES] = low * np.maximum(outside, 0.5 * (layout.up < CHIN - 0.9) * (np.abs(layout.right) < 0.8))
    weights[..., HAIR] = hair * ((layout.head < 0) & (layout.up > EYE_LINE - 0.3) & ~conservative)
    weights[..., FACE] = conservative
    return weights
