"""The reference's detail in the place of the input's (paper, "Face Detail Transfer")."""

from __future__ import annotations

from dataclasses import fields, replace
from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node
from graphface.nodes.blur import blurred
from graphface.nodes.types import (
    DetailMap,
    Features,
    FloatArray,
    Landmarks,
    Mask,
)

Scale = Annotated[float, Field(gt=0, le=2)]


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
    """The input's detail map with a band of the reference's in its place, as far as the mask says.

    Args:
        detail: the input's. reference: warped to the input, in the input's exposure (`makeup.exposed` with tone 0).
        mask: how much of the band is exchanged; 0 leaves every bit as it is.
        features: the input's. Lips are narrower than what is broad, so how dark they are would pass for relief, and a
            neutral lipstick has no color to be told by: with these, the darkness of lips over the skin stays too.
        broadest, finest: the band's ends as Gaussian scales, in inter-ocular distances: features broader than the one
            stay the input's (the light falling over its face is among them), and so do those finer than the other. None
            exchanges everything broad as well.

    Returns:
        A map with the parts (offset, gain, pivot) that either of the two has.
    """
    if not mask.any():
        return detail
    unit = max(landmarks.interocular, 1e-3)
    parts = {}
    for field in fields(reference):
        own, other = getattr(detail, field.name), getattr(reference, field.name)
        if own is None and other is None:
            continue
        neutral = np.zeros if field.name == "offset" else np.ones
        own, other = (v if v is not None else neutral((*mask.shape, 3), np.float32) for v in (own, other))
        lips = None if features is None else features.lips
        parts[field.name] = _exchanged(own, other, mask, broadest and broadest * unit, finest * unit, lips)
    return replace(detail, **parts)


def _exchanged(
    own: FloatArray, other: FloatArray, mask: Mask, broadest: float | None, finest: float, lips: Mask | None
) -> FloatArray:
    """own + mask * band(other - own), within the mask's box: the band is linear, so the difference alone is filtered.

    Broad differences are averaged over the mask only, so that eyes beside a cheek do not tint it, and over the lips
    apart from the skin.
    """
    rows, columns = np.flatnonzero(mask.any(axis=1)), np.flatnonzero(mask.any(axis=0))
    window = np.s_[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1]
    share = mask[window][..., None]
    difference = other[window] - own[window]
    band = difference if finest < 0.3 else blurred(difference, finest)
    if broadest is not None:
        weight = np.minimum(share, 1)
        if lips is None or not lips[window].any():
            broad = _averaged(difference, weight, broadest)
        else:
            within = lips[window][..., None]
            broad = _averaged(difference, weight * (1 - within), broadest)
            broad += within * (_averaged(difference, weight * within, broadest) - broad)
        band = band - broad
    changed = own.copy()
    changed[window] += share * band
    return changed


def _averaged(values: FloatArray, weight: FloatArray, sigma: float) -> FloatArray:
    """A Gaussian average over the weighted pixels; 0 far from all of them."""
    total = blurred(np.dstack([values * weight, weight]), max(sigma, 0.5))
    return np.asarray(total[..., :3] / np.maximum(total[..., 3:], np.float32(1e-3)), np.float32)
