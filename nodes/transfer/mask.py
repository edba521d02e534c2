"""Which pixels get how much of the reference's detail."""

from __future__ import annotations

from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from graphface import node, warn
from graphface.nodes.types import (
    Correspondence,
    Features,
    Mask,
    Regions,
)

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
