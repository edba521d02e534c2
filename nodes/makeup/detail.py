"""The blended detail map I_d^b(i, r) (paper, section "Makeup Transfer").

What makes a face its owner's is relief, and relief is fine: the line between the lips, the wings of the nose, the folds
of the lids. What makes up a face is broad: the darkness of a lipstick, a stripe. Around eyes, nose and mouth the
input's fine detail therefore sits on the reference's broad detail; in the openings all of it is the input's; elsewhere,
the reference's (caking, powder and smears are what real makeup looks like).
"""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node
from graphface.nodes.blur import blurred
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
    """The input's detail map in the openings, its fine part where `keep` says, else the reference's.

    Args:
        detail: the input's. reference: the reference's, warped to the input.
        fine: what counts as fine: the scale of the Gaussian that is taken off, in inter-ocular distances.

    Returns:
        A map with the parts (offset, gain, pivot) that either of the two has.
    """
    sigma = max(fine * landmarks.interocular, 0.5)
    opening = np.maximum(features.eyes, features.mouth)
    parts = {}
    for name in vars(reference):
        own, other = getattr(detail, name), getattr(reference, name)
        if own is not None or other is not None:
            neutral = np.zeros if name == "offset" else np.ones
            own, other = (v if v is not None else neutral((*keep.shape, 3), np.float32) for v in (own, other))
            parts[name] = _blended(own, other, keep, opening, features.lips, sigma)
    return replace(reference, **parts)


def _blended(own: FloatArray, other: FloatArray, keep: Mask, opening: Mask, lips: Mask, sigma: float) -> FloatArray:
    """other + keep * (fine(own) - fine(other)), and `own` in the openings. Taking the fine part is linear: one blur."""
    window = _box(keep)
    if window is None:
        return other
    blended = other.copy()
    difference = own[window] - other[window]
    broad = _broad(difference, lips[window], sigma)
    kept, openings, into = keep[window], opening[window], blended[window]

    def strip(rows: slice) -> None:
        share = kept[rows] * (1 - openings[rows])
        fully = in_three_channels(share + openings[rows])
        into[rows] += fully * difference[rows] - in_three_channels(share) * broad[rows]

    by_strips(strip, difference.shape)
    return blended


def _broad(values: FloatArray, lips: Mask, sigma: float) -> FloatArray:
    """Blurred, but not across the outline of the lips: how dark a thin lip is painted would count as fine otherwise."""
    broad = blurred(values, sigma)
    around = _box(lips, margin=round(3 * sigma))
    if around is not None:
        weight, near = lips[around], values[around]
        inner = blurred(np.dstack([near * weight[..., None], weight]), sigma)
        within, inside = inner[..., :3], inner[..., 3:]
        outside = np.maximum(1 - inside, _LEAST_WEIGHT)
        beyond = (broad[around] - within) / outside
        within /= np.maximum(inside, _LEAST_WEIGHT)
        broad[around] = beyond + weight[..., None] * (within - beyond)
    return broad


def _box(mask: Mask, margin: int = 0) -> tuple[slice, slice] | None:
    """The bounding box of what is not 0, grown by some pixels, or None."""
    rows, columns = np.flatnonzero(mask.any(axis=1)), np.flatnonzero(mask.any(axis=0))
    if rows.size == 0:
        return None
    first, last = (max(0, n[0] - margin) for n in (rows, columns)), (n[-1] + 1 + margin for n in (rows, columns))
    top, left = first
    bottom, right = last
    return slice(top, bottom), slice(left, right)
