"""Normals of a fitted head, refined from the picture, and the shadows that the photo's lamp casts on it.

A fitted model lacks the wings of this person's nose, the lids and the folds. The picture shows them, mixed with pigment
and light. A small network has learned from path-traced heads what shading says about relief, and what a cast shadow
looks like (see `normal_network` and the card beside the weights).
"""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node, warn
from graphface.nodes.color import channel_mean, in_three_channels
from graphface.nodes.strips import by_strips
from graphface.nodes.surface.cast_shadow import cast_shadow, off_hair
from graphface.nodes.surface.face_crop import INTEROCULAR, FaceCrop, face_crop
from graphface.nodes.surface.normal_network import (
    COVERAGE,
    NORMALS,
    NormalWeights,
    corrections,
    network_input,
    shipped_weights,
)
from graphface.nodes.types import FloatArray, Image, Landmarks, Lighting, Mask, RefinedSurface, Segmentation, Surface

_SHORTEST = 1e-3
"""Length of a changed normal from which it has a direction."""


@node("surface.refined")
def refined(
    surface: Surface,
    photo: Image,
    landmarks: Landmarks,
    mask: Mask,
    light: Lighting,
    labels: Segmentation | None = None,
    weights: NormalWeights | None = None,
    *,
    finer_than: Annotated[float, Field(gt=0, le=1)] = 0.12,
    strength: Annotated[float, Field(ge=0, le=2)] = 1.0,
) -> RefinedSurface:
    """The surface with normals that fit the picture, and the picture's cast shadows.

    Args:
        surface: of the photo's size. photo: any encoding.
        landmarks: any scheme; they give the position, size and roll of the face.
        mask: of the face, by which the picture's and the light's mean are taken.
        light: the estimated light, in the encoding of the photo.
        labels: hair, and what lies within 0.1 inter-ocular distances of it, keeps its normals. To the network a
            hairline is a step.
        weights: the shipped ones by default.
        finer_than: standard deviation of the Gaussian, in inter-ocular distances, whose smooth part of the correction
            is left out; 1 takes the whole correction. The fit's coarse shape is better on real faces than what a
            network makes of it that was taught by one family of heads.
        strength: factor of the correction; with 0 the network does not run, and no shadow is found.

    Returns:
        `surface` has unit normals within the crop about the face (1.1 inter-ocular distances to each side of it), as
        they were beyond; its depth, coverage and triangles stay. `shadow` is 0 off the face. A face that is not
        there, or a speck, keeps its normals and has no shadow, with a warning.
    """
    crop = face_crop(landmarks)
    covered = bool((surface.coverage > 0).any())
    if strength == 0 or not covered or crop.scale >= INTEROCULAR or not np.isfinite(light.coefficients).all():
        if strength != 0:
            warn("surface.refined: there is no face that could be refined; the normals stay as they are")
        return RefinedSurface(surface, np.zeros_like(surface.coverage))
    seen = network_input(crop, photo, surface, mask, light)
    arrays = shipped_weights() if weights is None else weights.arrays
    change, shadow = corrections(seen, arrays)
    change = np.float32(strength) * _fine(change, seen, finer_than)
    free = np.ones_like(shadow) if labels is None else off_hair(crop.sampled(labels.hair))
    change *= free[..., None]
    # Under the chin the gap of a collar is black in any light, and a lit neck would show it as a ragged line.
    on_face = free * crop.sampled(mask)
    cast = cast_shadow(crop, shadow, on_face, photo, landmarks, surface.coverage)
    return RefinedSurface(replace(surface, normals=_changed(surface, crop, change)), cast)


def _fine(change: FloatArray, seen: FloatArray, finer_than: float) -> FloatArray:
    """The change of unit normals on the crop, without its part that is smooth over more than `finer_than`."""
    import cv2

    before = seen[..., NORMALS:COVERAGE]
    covered = (before != 0).any(axis=2, keepdims=True)
    after = before + change
    after = after / np.maximum(np.sqrt(np.square(after).sum(axis=2, keepdims=True)), np.float32(1e-3))
    found = (after - before) * covered
    if finer_than >= 1:
        return np.asarray(found, np.float32)
    sigma = finer_than * INTEROCULAR
    shares = cv2.GaussianBlur(covered.astype(np.float32)[..., 0], (0, 0), sigma)[..., None]
    smooth = cv2.GaussianBlur(np.asarray(found, np.float32), (0, 0), sigma) / np.maximum(shares, np.float32(0.05))
    return np.asarray((found - smooth) * covered, np.float32)


def _changed(surface: Surface, crop: FaceCrop, change: FloatArray) -> FloatArray:
    top, bottom, left, right = window = crop.window(surface.coverage.shape)
    normals = surface.normals.copy()
    part = normals[top:bottom, left:right]
    added = crop.unwarped(crop.turned(change, back=True), window)

    def strip(rows: slice) -> None:
        new = part[rows] + added[rows]
        length = np.sqrt(3 * channel_mean(new * new))
        # Where there is no surface, or no direction left, the normal stays: the divisor is 1 and nothing is added.
        off = (surface.coverage[top:bottom, left:right][rows] <= 0) | (length <= _SHORTEST)
        if off.any():
            np.copyto(new, part[rows], where=off[..., None])
            length[off] = 1
        new /= in_three_channels(np.asarray(length, np.float32))
        part[rows] = new

    by_strips(strip, part.shape)
    return normals
