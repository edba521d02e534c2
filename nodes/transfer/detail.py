"""The input's detail map with the reference's in its place (paper, "Face Detail Transfer")."""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node
from graphface.nodes.blur import blurred, normalized
from graphface.nodes.bounding_box import bounding_box
from graphface.nodes.types import DetailMap, Features, FloatArray, Landmarks, Mask

Scale = Annotated[float, Field(gt=0, le=2)]


_NARROWEST_BLUR = 0.3
"""Sigma in pixels; a narrower Gaussian is a single pixel."""


@node("transfer.detail")
def detail(
    detail: DetailMap,
    reference: DetailMap,
    mask: Mask,
    landmarks: Landmarks,
    features: Features | None = None,
    *,
    broadest: Scale | None = 0.2,
    finest: Annotated[float, Field(ge=0, le=2)] = 0.0,
) -> DetailMap:
    """The input's detail map with a band of spatial frequencies exchanged for the reference's, by a mask.

    Args:
        detail: the input's. reference: warped to the input, in the input's exposure (`makeup.exposed` with tone 0).
        mask: how much of the band is exchanged; where it is 0 the map does not change by a bit.
        features: the input's. Lips are narrower than the broad features that stay the input's, so the darkness of a
            neutral lipstick would be transferred as relief; with these, the mean darkness of the lips stays, too.
        broadest, finest: the band's limits as sigmas of Gaussians, in inter-ocular distances. Features broader than
            the first stay the input's (the light falling over its face is among them), and so do those finer than the
            second. None exchanges everything broad as well.

    Returns:
        A map with the parts (offset, gain, pivot) that either of the two has.
    """
    if not mask.any():
        return detail
    unit = max(landmarks.interocular, 1e-3)
    lips = None if features is None else features.lips
    limits = broadest and broadest * unit, finest * unit
    pairs = detail.paired_with(reference).items()
    return replace(detail, **{name: _exchanged(*pair, mask, *limits, lips) for name, pair in pairs})


def _exchanged(
    of_input: FloatArray,
    of_reference: FloatArray,
    mask: Mask,
    broadest: float | None,
    finest: float,
    lips: Mask | None,
) -> FloatArray:
    """of_input + mask * band(of_reference - of_input); the band-pass filter is linear, so the difference is filtered.

    Broad differences are averaged over the mask only, so that eyes beside a cheek do not tint it, and over the lips
    apart from the skin.
    """
    box = bounding_box(mask)
    if box is None:
        return of_input
    share = mask[box][..., None]
    difference = of_reference[box] - of_input[box]
    band = difference if finest < _NARROWEST_BLUR else blurred(difference, finest)
    if broadest is not None:
        weight = np.minimum(share, 1)
        if lips is None or not lips[box].any():
            broad = _weighted_average(difference, weight, broadest)
        else:
            on_lips = lips[box][..., None]
            broad = _weighted_average(difference, weight * (1 - on_lips), broadest)
            broad += on_lips * (_weighted_average(difference, weight * on_lips, broadest) - broad)
        band = band - broad
    changed = of_input.copy()
    changed[box] += share * band
    return changed


def _weighted_average(values: FloatArray, weight: FloatArray, sigma: float) -> FloatArray:
    return normalized(values, weight[..., 0], max(sigma, 0.5), 1e-3, blurred)
