"""The blended detail map I_d^b(i, r) (paper, section "Makeup Transfer").

The paper keeps the input's detail map around eyes, nose and mouth, and takes the reference's elsewhere, where caking,
powder and smears are what makes makeup look real. Here a Gaussian splits both maps into two bands. A face's identity is
in fine relief: the line between the lips, the wings of the nose, the folds of the lids. Its makeup is broad: the
darkness of a lipstick, a stripe. So around eyes, nose and mouth the input's fine band is added to the reference's broad
band; in the openings of eyes and mouth both bands are the input's.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node
from graphface.nodes.blur import blurred
from graphface.nodes.bounding_box import bounding_box
from graphface.nodes.color import in_three_channels
from graphface.nodes.strips import by_strips
from graphface.nodes.types import DetailMap, Features, FloatArray, Landmarks, Mask

_LEAST_WEIGHT = np.float32(1e-3)


@node("makeup.detail")
def detail(
    detail: DetailMap,
    reference: DetailMap,
    keep: Mask,
    features: Features,
    landmarks: Landmarks,
    *,
    fine: Annotated[float, Field(gt=0, le=1)] = 0.04,
) -> DetailMap:
    """The reference's detail map with a share of the input's fine band, and all of the input's map in the openings.

    Args:
        detail: I_d^(i), the input's. reference: I_d^(r), warped to the input.
        keep: share of the fine band that is the input's, of `makeup.keep`.
        fine: sigma of the Gaussian that separates fine from broad detail, in inter-ocular distances.

    Returns:
        A map with the parts (offset, gain, pivot) that either of the two has.
    """
    sigma = max(fine * landmarks.interocular, 0.5)
    openings = features.openings
    pairs = detail.paired_with(reference).items()
    return replace(reference, **{name: _blended(*pair, keep, openings, features.lips, sigma) for name, pair in pairs})


def _blended(
    of_input: FloatArray, of_reference: FloatArray, keep: Mask, openings: Mask, lips: Mask, sigma: float
) -> FloatArray:
    """of_reference + keep * fine(of_input - of_reference) outside of the openings, and of_input in them.

    The high-pass filter `fine` is linear, so the difference alone is filtered.
    """
    box = bounding_box(keep)
    if box is None:
        return of_reference
    blended = of_reference.copy()
    difference = of_input[box] - of_reference[box]
    broad = _broad(difference, lips[box], sigma)
    keep, openings, into = keep[box], openings[box], blended[box]

    def strip(rows: slice) -> None:
        share = keep[rows] * (1 - openings[rows])
        whole = in_three_channels(share + openings[rows])
        into[rows] += whole * difference[rows] - in_three_channels(share) * broad[rows]

    by_strips(strip, difference.shape)
    return blended


def _broad(values: FloatArray, lips: Mask, sigma: float) -> FloatArray:
    """Low-pass filtered, with lips and skin apart: else the darkness of a lipstick on thin lips would count as fine."""
    broad = blurred(values, sigma)
    around = bounding_box(lips, margin=round(3 * sigma))
    if around is not None:
        weight, near = lips[around], values[around]
        sums = blurred(np.dstack([near * weight[..., None], weight]), sigma)
        on_lips, weight_on_lips = sums[..., :3], sums[..., 3:]
        on_skin = (broad[around] - on_lips) / np.maximum(1 - weight_on_lips, _LEAST_WEIGHT)
        on_lips /= np.maximum(weight_on_lips, _LEAST_WEIGHT)
        broad[around] = on_skin + weight[..., None] * (on_lips - on_skin)
    return broad
