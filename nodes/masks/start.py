"""What the classifiers of a photo start from: what is expected of every pixel, and which pixels teach at first.

Either where things tend to be and the seeds of the paper (`start_from_place`), or a cue that has already looked
(`start_from_cue`).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.head_shape import CHIN, EYE_LINE
from graphface.nodes.masks.exposed_skin import bare_skin
from graphface.nodes.masks.hair import skin_weights
from graphface.nodes.masks.prior import BACKDROP, CLOTHES, FACE, HAIR, Layout, log_prior, log_sum_exp
from graphface.nodes.types import FloatArray

BARE = 6.0
"""Added to the score of face, and taken off the score of hair, where the forehead surely goes on."""


NO_HAIR = 6.0
"""Taken off the score of hair everywhere where the detector found none; half of it where no pixel is surer than 1/4."""


TRUST = 0.5
"""Weight of a cue's log chances beside the likeness of colors: it saw less of the photo than those, and is unsure of
edges. On photos and heads that took no part in its learning anything from 0.35 to 0.7 is within 0.004 of the best."""


LEAST_CHANCE = 1e-4
"""A cue is never surer than this against a label: colors must be able to overrule it."""


@dataclass(frozen=True)
class Start:
    """`expected` scores and first `belief`, h x w x 4 in the order FACE, HAIR, BACKDROP, CLOTHES; `skin` (n,): how much
    each pixel teaches face, None where that is as much as it is believed to be face."""

    expected: FloatArray
    belief: FloatArray
    skin: FloatArray | None


def start_from_place(
    values: FloatArray,
    layout: Layout,
    sure: NDArray[np.bool_],
    aggressive: FloatArray,
    response: FloatArray,
    unit: float,
    weight: float,
) -> Start:
    """The paper's: conservative mask, what is beyond the aggressive one, and the detector's hair.

    Args:
        values: features h x w x D. sure: the conservative mask. response: of the hair detector.
        unit: inter-ocular distance in pixels. weight: of the prior's scores.
    """
    bare = bare_skin(values, sure & ~layout.features, layout, unit)
    skin = (sure & ~layout.features) | (bare > 0.5)
    expected = weight * log_prior(layout)
    expected[..., FACE] += BARE * bare
    expected[..., HAIR] -= BARE * bare
    belief = _seeds(sure, aggressive, response, layout)
    expected[..., HAIR] -= NO_HAIR * max(0.0, 1 - 2 * float(belief[..., HAIR].max()))
    return Start(expected, belief, skin_weights(values, skin))


def start_from_cue(
    face: FloatArray,
    hair: FloatArray,
    layout: Layout,
    sure: NDArray[np.bool_],
    aggressive: FloatArray,
    response: FloatArray,
    weight: float,
) -> Start:
    """A cue's probabilities; what is neither face nor hair backdrop and clothes share by their place.

    Args:
        face, hair: h x w. aggressive: beyond that mask nothing teaches face at first.
        response: what is hair for certain, where that was said by somebody else: it takes its share of first belief.
        weight: of what the cue says, beside `TRUST`.
    """
    place = log_prior(layout)[..., BACKDROP:]
    share = place - log_sum_exp(place)
    told = np.log(np.clip(np.dstack([face, hair, 1 - face - hair]), LEAST_CHANCE, 1))
    expected = np.asarray(weight * TRUST * np.dstack([told[..., :BACKDROP], told[..., BACKDROP:] + share]), np.float32)
    belief = np.exp(expected - log_sum_exp(expected))
    belief[..., FACE] *= aggressive
    belief[..., HAIR] = 0
    belief *= ((1 - response) / np.maximum(belief.sum(axis=2), 1e-6))[..., None]
    belief[..., HAIR] = response
    belief[sure] = np.eye(4, dtype=np.float32)[FACE]
    return Start(expected, np.asarray(belief, np.float32), None)


def _seeds(sure: NDArray[np.bool_], aggressive: FloatArray, response: FloatArray, layout: Layout) -> FloatArray:
    """First beliefs, h x w x 4, all 0 where nothing is assigned."""
    belief = np.zeros((*sure.shape, 4), np.float32)
    outside = (aggressive < 0.5) * (1 - response)
    low = layout.high < CHIN - 0.35
    belief[..., BACKDROP] = outside * ~low
    belief[..., CLOTHES] = low * np.maximum(outside, 0.5 * (layout.high < CHIN - 0.9) * (np.abs(layout.right) < 0.8))
    belief[..., HAIR] = response * ((layout.head < 0) & (layout.high > EYE_LINE - 0.3) & ~sure)
    belief[..., FACE] = sure
    return belief
