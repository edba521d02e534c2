"""Detail transfer between regions of two faces, the input's light and albedo kept (paper, "Face Detail Transfer")."""

from __future__ import annotations

from dataclasses import fields, replace
from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from graphface import node, warn
from graphface.nodes.blur import blurred
from graphface.nodes.colour import channel_mean
from graphface.nodes.detail.rendering import in_three_channels
from graphface.nodes.makeup.features import Features
from graphface.nodes.regions import Regions
from graphface.nodes.strips import by_strips
from graphface.nodes.types import Albedo, DetailMap, FloatArray, Image, Landmarks, Mask
from graphface.nodes.warp.correspondence import Correspondence

Region = Literal[
    "left_brow",
    "right_brow",
    "left_eye",
    "right_eye",
    "forehead",
    "nose",
    "mouth",
    "left_cheek",
    "right_cheek",
]
Strength = Annotated[float, Field(ge=0, le=2)]
Scale = Annotated[float, Field(gt=0, le=2)]

_LEAST_COLOUR = np.float32(0.05)
_DARK = np.float32(0.03)
"""Added to colour and intensity: what is nearly black is grey."""

REGIONS: tuple[Region, ...] = Region.__args__  # type: ignore[attr-defined]


@node("transfer.mask")
def mask(
    regions: Regions,
    correspondence: Correspondence,
    features: Features | None = None,
    skin: Mask | None = None,
    given: Mask | None = None,
    paint: Mask | None = None,
    *,
    take: tuple[Region, ...] = REGIONS,
    strength: Strength = 1.0,
    strengths: dict[Region, Strength] = {},  # noqa: B006 - pydantic copies it
    openings: Strength = 0.0,
    painted: Strength = 0.0,
) -> Mask:
    """How much of the reference's detail each pixel gets.

    Args:
        regions: the input's. correspondence: parts that the reference hides keep the input's detail.
        features: the input's; `openings` of its eyes and mouth get that share (a gaze and teeth are no detail of skin).
        skin: where the input's detail may be changed; hair in front of the face is not skin.
        given: a user's own mask, multiplied on top.
        paint: where the reference is painted (`transfer.paint`); `painted` of that gets this share.
        take: which regions; none leaves the photo as it is. Left and right are the person's own.
        strength: of all; `strengths`: of single regions, in its place. Above 1 detail is exaggerated.

    Returns:
        H x W, 0..2.
    """
    if not take:
        warn("transfer.mask: no region was asked for; the photo stays as it is")
    total = np.zeros_like(regions.nose)
    for name in dict.fromkeys(take):
        total += getattr(regions, name) * np.float32(strengths.get(name, strength))
    total *= correspondence.known * correspondence.inside
    if features is not None:
        total *= 1 - np.maximum(features.eyes, features.mouth) * np.float32(1 - min(openings, 1))
    if paint is not None:
        total *= 1 - paint * np.float32(1 - min(painted, 1))
    for factor in (skin, given):
        if factor is not None:
            total *= np.clip(factor, 0, 1)
    return total


@node("transfer.paint")
def paint(
    photo: Image,
    reference: Image,
    mask: Mask,
    landmarks: Landmarks,
    *,
    faint: Annotated[float, Field(ge=0, le=2)] = 0.12,
    full: Annotated[float, Field(gt=0, le=2)] = 0.3,
    margin: Scale = 0.03,
    resolution: Annotated[int, Field(ge=8, le=256)] = 80,
) -> Mask:
    """Where the reference is another colour than the same place of the photo, each measured by its own skin.

    Lipstick darkens what it lies on, and so does a drawn moon: that is no relief, and colours stay the photo's.

    Args:
        photo, reference: the photo, and the reference warped to it. Colour is that over intensity, as photographed: an
            albedo may have been given the skin's colour where it is dark.
        mask: the faces' common part, over which the colour of the skin is the median.
        faint, full: difference of colour, the skin's being 1, at which paint begins and is certain.
        margin: width added around what is found, in inter-ocular distances: paint has edges.
        resolution: pixels per inter-ocular distance of the copy on which it is decided.
    """
    import cv2

    unit = max(landmarks.interocular, 1e-3)
    scale = min(1.0, resolution / unit)
    size = [max(1, round(n * scale)) for n in mask.shape[::-1]]
    unit *= scale

    def small(values: FloatArray) -> FloatArray:
        return np.asarray(cv2.resize(values, size, interpolation=cv2.INTER_AREA), np.float32)

    where = small(mask) > 0.5
    if not where.any():
        return np.zeros_like(mask)
    colours = []
    for pixels in (small(photo.pixels), small(reference.pixels)):
        colour = (pixels + _DARK) / in_three_channels(np.maximum(channel_mean(pixels), 0) + _DARK)
        colours.append(colour / np.maximum(np.median(colour[where], axis=0), _LEAST_COLOUR))
    apart = np.abs(colours[0] - colours[1]).max(axis=2).astype(np.float32)
    apart = cv2.GaussianBlur(apart, (0, 0), max(0.02 * unit, 0.5))
    apart = cv2.dilate(apart, cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (2 * round(margin * unit) + 1,) * 2))
    found = np.clip((apart - faint) / max(full - faint, 1e-3), 0, 1).astype(np.float32)
    shown = cv2.resize(found, mask.shape[::-1], interpolation=cv2.INTER_LINEAR)
    return np.asarray(np.clip(shown, 0, 1) * (mask > 0), np.float32)


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
            neutral lipstick has no colour to be told by: with these, the darkness of lips over the skin stays too.
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


@node("transfer.recoloured")
def recoloured(
    detail: DetailMap, reference: Albedo, albedo: Albedo, *, floor: Annotated[float, Field(gt=0, le=1)] = 0.1
) -> DetailMap:
    """The reference's detail on the input's albedo: a wrinkle darkens the skin that it lies in.

    The additive map is rho (s - SH), so its colour is the albedo's; taken as it is, the shadow of a red lip would leave
    a green one on pale skin. s - SH is read off the means of both over the channels, and what the two albedos differ by
    is moved along with it: equal albedos leave the map as it is, to the last bit, also where the floor is at work.

    Args:
        reference, albedo: the reference's, warped to the input, and the input's.
        floor: least mean albedo divided by.
    """
    offset = np.empty_like(detail.offset)
    pivot = None if detail.pivot is None else np.empty_like(detail.pivot)

    def strip(rows: slice) -> None:
        own, other = albedo[rows], reference[rows]
        least = np.maximum(channel_mean(other), np.float32(floor))
        moved = np.asarray(channel_mean(detail.offset[rows]) / least, np.float32)
        offset[rows] = detail.offset[rows] + (own - other) * in_three_channels(moved)
        if pivot is not None and detail.pivot is not None:
            lighter = np.asarray(channel_mean(own) / least, np.float32)
            pivot[rows] = np.asarray(detail.pivot[rows] * in_three_channels(lighter), np.float32)

    by_strips(strip, offset.shape)
    return replace(detail, offset=offset, pivot=pivot, ceiling=None)


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
