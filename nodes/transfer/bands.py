"""The photo's detail map with the relief of the reference's skin."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Annotated, Literal

import numpy as np
from pydantic import Field

from graphface import node
from graphface.nodes.blur import blurred
from graphface.nodes.bounding_box import Box, bounding_box
from graphface.nodes.color import channel_mean
from graphface.nodes.face_scale import FaceScale, face_scale
from graphface.nodes.relief import FLOOR, USUAL, WIDTHS, Relief, logarithm, relief
from graphface.nodes.transfer.chosen import Which, chosen
from graphface.nodes.types import REGIONS, DetailMap, FloatArray, Image, Landmarks, Mask, Regions

if TYPE_CHECKING:
    Region = str
else:
    Region = Literal[REGIONS]  # a type checker cannot read names that are written only once

Band = Literal["pores", "lines", "folds"]
Strength = Annotated[float, Field(ge=0, le=4)]

_LARGEST_CHANGE = np.float32(1.0)
"""Of the logarithm of intensity, in either direction."""

_TILT = np.float32(1.0)
"""How much more a channel changes by relief for each unit that its logarithm lies below the mean of the channels.
Measured as 1.0 to 1.5 in every band, dark and bright, on pale and dark skin alike: relief is nearly grey light, so it
shows least in red. In all channels alike wrinkles would look like pencil."""

_FAINT = np.float32(0.02)
"""Relief, of the logarithm of intensity, that is not seen."""

_COARSER = 1.2
"""Ratio of the faces' sizes from which on the reference cannot show the finest of what the photo shows."""


@node("transfer.bands")
def bands(
    detail: DetailMap,
    photo: Image,
    mask: Mask,
    skin: Mask,
    landmarks: Landmarks,
    reference: Image | None = None,
    reference_landmarks: Landmarks | None = None,
    regions: Regions | None = None,
    *,
    pores: Strength = 1.0,
    lines: Strength = 1.0,
    folds: Strength = 1.0,
    regional: dict[Region, dict[Band, Strength]] = {},  # noqa: B006 - pydantic copies it
    which: Which = "all",
    harshest: Annotated[float, Field(gt=0, le=10)] | None = 1.0,
    resolution: Annotated[int, Field(ge=8, le=256)] = 100,
) -> DetailMap:
    """The photo's own relief taken out of its skin and the reference's put in, band by band, as ratios of intensity.

    Its own goes in every channel, so that a glint leaves no grey spot. The reference's comes as intensity alone, in the
    color that relief has on the photo's skin (`_TILT`).

    Args:
        detail: the photo's, additive.
        mask: how much is exchanged; where it is 0 the map does not change by a bit.
        skin: where both photos show skin (`transfer.skin`); relief is measured there only.
        reference: warped to the photo; without one its skin is perfectly smooth.
        landmarks, reference_landmarks: their size says what is too fine for the reference to show; that stays.
        regions: the photo's, for `regional`.
        pores, lines, folds: strength of the bands up to 0.01, 0.03 and 0.07 inter-ocular distances.
        regional: factors of a band in a region, on top of its strength.
        which: "all" exchanges; "deeper" and "smoother" only where the reference has more, or less; "spots" adds the
            reference's dark spots (freckles, moles), in color, to what the photo has.
        harshest: root mean square of a band, as a multiple of what four of five portraits stay below, from which on it
            is scaled down, though never below the photo's own; None carries a hard light or a sharpened picture as it
            is.
        resolution: pixels per inter-ocular distance of the copy on which the relief's base is computed.
    """
    box = bounding_box(mask, margin=round(4 * WIDTHS["folds"] * landmarks.interocular))
    if box is None:
        return detail
    copy = face_scale(landmarks, mask[box].shape, resolution)
    pixels, share, on_skin = photo.pixels[box], mask[box], skin[box]
    values = logarithm(pixels)
    own = relief(np.dstack([values, channel_mean(values)]), on_skin, copy)
    other = _of_reference(reference, box, which, on_skin, copy)
    coarser = 1.0 if reference_landmarks is None else landmarks.interocular / max(reference_landmarks.interocular, 1e-3)
    taken, given = np.zeros_like(own.pores), np.zeros_like(other.pores)
    strengths: dict[Band, float] = {"pores": pores, "lines": lines, "folds": folds}
    for band, strength in strengths.items():
        weight = share * np.float32(strength)
        if regions is not None:
            weight = weight * _regional(regional, band, regions)[box]
        if not weight.any():
            continue
        mine, theirs = getattr(own, band), getattr(other, band)
        theirs = theirs * np.float32(_moderation(mine, theirs, share, USUAL[band], harshest))
        if band == "pores" and coarser > _COARSER:
            mine = blurred(mine, 0.5 * coarser)
        if band == "folds":
            mine = _without_color_of_shadows(mine)
        out, into = chosen(which, mine, theirs, 2 * WIDTHS[band] * landmarks.interocular)
        taken += weight[..., None] * out
        given += weight[..., None] * into
    offset = detail.offset.copy()
    offset[box] += _exchanged(pixels, taken, given) - pixels
    return replace(detail, offset=offset)


def _of_reference(reference: Image | None, box: Box, which: Which, skin: Mask, copy: FaceScale) -> Relief:
    """Its relief, H x W x 3 for spots, which have a color, and else H x W x 1."""
    if reference is None:
        nothing = np.zeros((*skin.shape, 1), np.float32)
        return Relief(nothing, nothing, nothing)
    values = logarithm(reference.pixels[box])
    return relief(values if which == "spots" else channel_mean(values)[..., None], skin, copy)


def _regional(regional: Mapping[Region, Mapping[Band, Strength]], band: Band, regions: Regions) -> FloatArray:
    """The factors of a band, H x W."""
    factor = np.ones_like(regions.nose)
    for region, factors in regional.items():
        factor += getattr(regions, region) * np.float32(factors.get(band, 1.0) - 1)
    return factor


def _without_color_of_shadows(folds: FloatArray) -> FloatArray:
    """What is bright and broad is shine, which is grey; what is dark has the color of the skin and leaves it there."""
    light = folds[..., 3:]
    return np.where(light > 0, folds, light)


def _moderation(own: FloatArray, other: FloatArray, mask: Mask, usual: float, harshest: float | None) -> float:
    """The factor by which a band of the reference is scaled down."""
    inside = mask > 0.5
    if harshest is None or not inside.any():
        return 1.0
    of_own, of_other = (float(np.sqrt(np.mean(np.square(band.mean(axis=2)[inside])))) for band in (own, other))
    return min(1.0, max(harshest * usual, of_own) / max(of_other, 1e-4))


def _exchanged(pixels: FloatArray, taken: FloatArray, given: FloatArray) -> FloatArray:
    """Pixels without one relief (H x W x 4, the last the mean) and with another (H x W x 1 or 3).

    Where the two are the same the pixels stay: a face onto itself is the face.
    """
    own = taken[..., 3:]
    change = np.abs(given - own).mean(axis=2, keepdims=True)
    size = (np.abs(given).mean(axis=2, keepdims=True) + np.abs(own)) / 2
    colored = given
    if given.shape[2] == 1:
        bare = logarithm(pixels) - taken[..., :3]
        colored = given * np.clip(1 + _TILT * (channel_mean(bare)[..., None] - bare), 0.5, 2)
    different = np.minimum(change / (size + _FAINT), 1)
    exponent = given - own + different * (colored - given + own - taken[..., :3])
    ratio = np.exp(np.clip(exponent, -_LARGEST_CHANGE, _LARGEST_CHANGE))
    return np.asarray((pixels + FLOOR) * ratio - FLOOR, np.float32)
